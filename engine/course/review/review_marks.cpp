#include "course/review/review_marks.h"

#include <algorithm>
#include <cmath>

namespace dynlab::inline course {
namespace {

constexpr double kOutlierDistance = 0.35;  // of the scale, on average over the criteria
constexpr double kLowPercent = 40;         // of all points: what may call for revenge
constexpr double kZeroDistance = 2;        // half the scale away on average earns nothing

std::optional<double> median(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

std::optional<double> mean(const std::vector<double>& values) {
    if (values.empty()) return {};
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

class ReviewMarker {
  public:
    ReviewMarker(const std::vector<Criterion>& criteria, const std::vector<ScoredReview>& reviews)
        : criteria_(criteria), reviews_(reviews) {}

    GroupMark group(std::int64_t id) const {
        GroupMark mark;
        mark.group = id;
        for (std::size_t c = 0; c < criteria_.size(); ++c) mark.medians.push_back(median(scores(id, c, nullptr)));
        mark.work = percent_of(criteria_, mark.medians);
        std::vector<double> earned;
        for (const ScoredReview& r : reviews_) {
            if (r.reviewer != id || id == 0) continue;
            if (const auto d = review(r).distance) earned.push_back(100 * std::max(0.0, 1 - kZeroDistance * *d));
        }
        mark.reviews = mean(earned);
        return mark;
    }

    ReviewMark review(const ScoredReview& r) const {
        ReviewMark mark;
        mark.pair = r.pair;
        std::vector<double> distances, below;
        for (std::size_t c = 0; c < criteria_.size(); ++c) {
            const auto own = instructor_s(r.author, c);
            const auto others = own ? own : median(scores(r.author, c, &r));
            if (!others || !r.points[c]) continue;
            distances.push_back(std::abs(*r.points[c] - *others) / criteria_[c].max_points);
            below.push_back((*others - *r.points[c]) / criteria_[c].max_points);
        }
        mark.distance = mean(distances);
        mark.outlier = !below.empty() && *mean(below) > kOutlierDistance;
        mark.retaliation = mark.outlier && was_hurt_by(r.reviewer, r.author);
        return mark;
    }

  private:
    /// What the reviews of a report gave for a criterion, one of them left out.
    std::vector<double> scores(std::int64_t author, std::size_t criterion, const ScoredReview* but) const {
        std::vector<double> values;
        for (const ScoredReview& r : reviews_)
            if (r.author == author && &r != but && r.points[criterion]) values.push_back(*r.points[criterion]);
        return values;
    }

    std::optional<double> instructor_s(std::int64_t author, std::size_t criterion) const {
        for (const ScoredReview& r : reviews_)
            if (r.author == author && r.reviewer == 0 && r.pair == 0) return r.points[criterion];
        return {};
    }

    /// Whether `author` gave the report of `reviewer` few points.
    bool was_hurt_by(std::int64_t reviewer, std::int64_t author) const {
        for (const ScoredReview& r : reviews_) {
            if (r.reviewer != author || r.author != reviewer) continue;
            if (percent_of(criteria_, r.points).value_or(100) < kLowPercent) return true;
        }
        return false;
    }

    const std::vector<Criterion>& criteria_;
    const std::vector<ScoredReview>& reviews_;
};

/// The newest mark of a student, or else of the group; null where there is none.
const GivenMark* instructors_word(const std::vector<GivenMark>& given, std::int64_t group, const std::string& student,
                                  const char* item) {
    const GivenMark *of_student = nullptr, *of_group = nullptr;
    for (const GivenMark& mark : given) {
        if (mark.item != item) continue;
        if (mark.student.empty() && mark.group == group) of_group = &mark;
        if (!student.empty() && mark.student == student) of_student = &mark;
    }
    return of_student != nullptr ? of_student : of_group;
}

}  // namespace

std::optional<double> percent_of(const std::vector<Criterion>& criteria, const CriterionPoints& points) {
    double sum = 0, max_points = 0;
    for (std::size_t c = 0; c < criteria.size(); ++c)
        if (points[c]) sum += *points[c], max_points += criteria[c].max_points;
    if (max_points == 0) return {};
    return 100 * sum / max_points;
}

GivenPoints points_by_owner(const Assignment& assignment, const std::vector<GivenMark>& marks) {
    GivenPoints given;
    for (const GivenMark& mark : marks) {
        const auto criterion = std::ranges::find(assignment.criteria, mark.item, &Criterion::name);
        if (criterion == assignment.criteria.end()) continue;
        CriterionPoints& points = mark.pair != 0          ? given.pairs[mark.pair]
                                  : !mark.student.empty() ? given.students[mark.student]
                                  : mark.stage == "final" ? given.finals[mark.group]
                                                          : given.groups[mark.group];
        points.resize(assignment.criteria.size());
        points[static_cast<std::size_t>(criterion - assignment.criteria.begin())] = mark.points;
    }
    return given;
}

const StudentMark* GroupMark::own_points_of(const std::string& student) const {
    const auto own = std::ranges::find(students, student, &StudentMark::student);
    return own == students.end() ? nullptr : &*own;
}

FinalMark Marks::work_of(const GroupMark& mark, const std::string& student) const {
    if (const GivenMark* const word = instructors_word(given, mark.group, student, kWholeItem))
        return {word->points, word};
    const StudentMark* const own = mark.own_points_of(student);
    return {own != nullptr ? own->work : mark.work, nullptr};
}

FinalMark Marks::reviews_of(const GroupMark& mark, const std::string& student) const {
    const GivenMark* const word = instructors_word(given, mark.group, student, kReviewsItem);
    return word != nullptr ? FinalMark{word->points, word} : FinalMark{mark.reviews, nullptr};
}

std::vector<Message> Marks::costs_of(const GroupMark& mark, const std::string& student) const {
    std::vector<Message> costs;
    if (work_of(mark, student).given == nullptr) costs = mark.costs_of_work;
    if (reviews_of(mark, student).given == nullptr)
        costs.insert(costs.end(), mark.costs_of_reviews.begin(), mark.costs_of_reviews.end());
    return costs;
}

Marks marks_of(const std::vector<Criterion>& criteria, const std::vector<ScoredReview>& reviews,
               const std::vector<std::int64_t>& groups) {
    const ReviewMarker marking(criteria, reviews);
    Marks marks;
    for (const std::int64_t id : groups) marks.groups.push_back(marking.group(id));
    for (const ScoredReview& review : reviews) marks.reviews.push_back(marking.review(review));
    return marks;
}

}  // namespace dynlab::inline course
