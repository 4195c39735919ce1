#include "course/review/review_marks.h"

#include <algorithm>
#include <cmath>

namespace dynlab::inline course {
namespace {

constexpr double kOutlierDistance = 0.35;  // of the scale, on average over the criteria
constexpr double kLowScoreShare = 0.4;     // of all points: what may call for revenge
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
        double sum = 0, most = 0;
        for (std::size_t c = 0; c < criteria_.size(); ++c) {
            mark.medians.push_back(median(scores(id, c, nullptr)));
            if (!mark.medians.back()) continue;
            sum += *mark.medians.back(), most += criteria_[c].most;
        }
        if (most > 0) mark.work = 100 * sum / most;
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
            distances.push_back(std::abs(*r.points[c] - *others) / criteria_[c].most);
            below.push_back((*others - *r.points[c]) / criteria_[c].most);
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
            double sum = 0, most = 0;
            for (std::size_t c = 0; c < criteria_.size(); ++c)
                if (r.points[c]) sum += *r.points[c], most += criteria_[c].most;
            if (most > 0 && sum < kLowScoreShare * most) return true;
        }
        return false;
    }

    const std::vector<Criterion>& criteria_;
    const std::vector<ScoredReview>& reviews_;
};

}  // namespace

const StudentMark* GroupMark::own_points_of(const std::string& student) const {
    const auto own = std::ranges::find(students, student, &StudentMark::student);
    return own == students.end() ? nullptr : &*own;
}

std::optional<double> GroupMark::work_mark_of(const std::string& student) const {
    const StudentMark* const own = work_override ? nullptr : own_points_of(student);
    return own ? own->work : work_mark();
}

const GivenMark* Marks::own_mark(const std::string& student, const std::string& item) const {
    const GivenMark* found = nullptr;
    for (const GivenMark& mark : own)
        if (mark.student == student && mark.item == item) found = &mark;
    return found;
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
