#include "course/review/allocation.h"

#include <algorithm>

#include "numerics/error.h"

namespace dynlab::inline course {
namespace {

/// The pairs under construction, with what is forbidden.
class Board {
  public:
    explicit Board(const AllocationProblem& problem)
        : n_(problem.groups),
          cells_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_), kFree),
          writes_(static_cast<std::size_t>(n_), 0),
          gets_(static_cast<std::size_t>(n_), 0) {
        for (int i = 0; i < n_; ++i) at(i, i) = kForbidden;
        for (const auto& [a, b] : problem.kin) at(a, b) = at(b, a) = kForbidden;
        for (const auto& [reviewer, author] : problem.fixed) {
            at(reviewer, author) = kFixed;
            count(reviewer, author, 1);
        }
    }

    bool free(int r, int a) const { return at(r, a) == kFree; }
    bool loose(int r, int a) const { return at(r, a) == kLoose; }
    bool any(int r, int a) const { return at(r, a) >= kLoose; }
    int writes(int r) const { return writes_[static_cast<std::size_t>(r)]; }
    int gets(int a) const { return gets_[static_cast<std::size_t>(a)]; }
    void add(int r, int a) {
        at(r, a) = kLoose;
        count(r, a, 1);
    }
    void remove(int r, int a) {
        at(r, a) = kFree;
        count(r, a, -1);
    }
    int size() const { return n_; }

  private:
    enum Cell : char { kForbidden, kFree, kLoose, kFixed };
    Cell& at(int r, int a) { return cells_[static_cast<std::size_t>(r * n_ + a)]; }
    Cell at(int r, int a) const { return cells_[static_cast<std::size_t>(r * n_ + a)]; }
    void count(int r, int a, int by) {
        writes_[static_cast<std::size_t>(r)] += by;
        gets_[static_cast<std::size_t>(a)] += by;
    }

    int n_;
    std::vector<Cell> cells_;
    std::vector<int> writes_, gets_;
};

class Allocator {
  public:
    Allocator(const AllocationProblem& problem, const UniformDraw& draw)
        : problem_(problem), board_(problem), draw_(draw) {
        for (int i = 0; i < problem.groups; ++i)
            if (problem.active[static_cast<std::size_t>(i)]) order_.push_back(i);
        shuffle_items(order_, draw_);
        requested_ = std::max(0, std::min(problem.reviews, static_cast<int>(order_.size()) - 1));
    }

    Allocation run() {
        refuse_impossible();
        if (problem_.fixed.empty() && problem_.loose.empty())
            start_with_circle();
        else
            keep_loose();
        mix();
        for (int more = 0; more <= 2 && open() > 0; ++more) fill(requested_ + more);
        avoid_swaps();
        return result();
    }

  private:
    void refuse_impossible() const {
        const int others = static_cast<int>(order_.size()) - 1;
        if (problem_.fixed.empty() && problem_.loose.empty() && problem_.reviews > others)
            throw order_.size() == 1
                ? InvalidArgument(
                      "the requested number of reviews per group is {}, but only {} group has a report, so the largest "
                      "possible number is {}. Wait for more first versions",
                      problem_.reviews, order_.size(), std::max(0, others))
                : InvalidArgument(
                      "the requested number of reviews per group is {}, but only {} groups have a report, so the "
                      "largest possible number is {}. Wait for more first versions, or decrease --reviews of the "
                      "assignment",
                      problem_.reviews, order_.size(), std::max(0, others));
    }

    void start_with_circle() {
        const std::size_t n = order_.size();
        for (std::size_t i = 0; i < n; ++i)
            for (int step = 1; step <= requested_; ++step) {
                const int author = order_[(i + static_cast<std::size_t>(step)) % n];
                if (board_.free(order_[i], author)) board_.add(order_[i], author);
            }
    }

    bool active(int group) const { return problem_.active[static_cast<std::size_t>(group)]; }

    void keep_loose() {
        for (const auto& [r, a] : problem_.loose)
            if (active(r) && active(a) && board_.free(r, a) && board_.writes(r) < requested_ &&
                board_.gets(a) < requested_)
                board_.add(r, a);
    }

    std::vector<ReviewEdge> loose_pairs() const {
        std::vector<ReviewEdge> pairs;
        for (int r = 0; r < board_.size(); ++r)
            for (int a = 0; a < board_.size(); ++a)
                if (board_.loose(r, a)) pairs.emplace_back(r, a);
        return pairs;
    }

    /// Couples that (r, a) would make with what is there.
    int couples(int r, int a) const { return board_.any(a, r) ? 1 : 0; }

    /// Exchanges the reports of two reviewers, if that is allowed and adds no couples. Returns whether the exchange
    /// happened.
    bool exchange(ReviewEdge& one, ReviewEdge& other, bool only_better) {
        const auto [r1, a1] = one;
        const auto [r2, a2] = other;
        if (r1 == r2 || a1 == a2 || !board_.free(r1, a2) || !board_.free(r2, a1)) return false;
        const int before = couples(r1, a1) + couples(r2, a2);
        board_.remove(r1, a1), board_.remove(r2, a2);
        board_.add(r1, a2), board_.add(r2, a1);
        const int after = couples(r1, a2) + couples(r2, a1);
        if (after < before || (!only_better && after == before)) {
            one = {r1, a2}, other = {r2, a1};
            return true;
        }
        board_.remove(r1, a2), board_.remove(r2, a1);
        board_.add(r1, a1), board_.add(r2, a2);
        return false;
    }

    /// A fresh circle would let neighbors read the same reports; random exchanges take that order away.
    void mix() {
        if (!problem_.loose.empty() || !problem_.fixed.empty()) return;
        std::vector<ReviewEdge> pairs = loose_pairs();
        if (pairs.size() < 2) return;
        for (std::size_t i = 0; i < 10 * pairs.size(); ++i) {
            const std::size_t one = draw_(pairs.size()), other = draw_(pairs.size());
            exchange(pairs[one], pairs[other], false);
        }
    }

    /// Reviews that are still to be written or got, to reach what is wanted.
    int open() const {
        int sum = 0;
        for (const int i : order_)
            sum += std::max(0, requested_ - board_.writes(i)) + std::max(0, requested_ - board_.gets(i));
        return sum;
    }

    /// Looks for reviewers below what is wanted while no report gets more than `max_reviews`; then for reports.
    void fill(int max_reviews) {
        for (const int i : order_)
            while (board_.writes(i) < requested_ && extend(i, max_reviews)) continue;
        for (const int i : order_)
            while (board_.gets(i) < requested_ && extend_backwards(i, max_reviews)) continue;
    }

    /// One more review for reviewer `from`: straight, or along the shortest chain in which each reviewer hands a loose
    /// review on and takes another. The chain ends at a report that gets less than `max_reviews`, of these one that
    /// gets less than wanted first.
    bool extend(int from, int max_reviews) {
        for (const int limit :
             max_reviews > requested_ ? std::vector{requested_, max_reviews} : std::vector{max_reviews})
            if (chain(from, [&](int author) { return board_.gets(author) < limit; })) return true;
        return false;
    }

    template <class Ends>
    bool chain(int from, const Ends& ends) {
        const auto n = static_cast<std::size_t>(board_.size());
        std::vector<int> taken_from(n, -1), submitted_by(n, -1);  // report -> reviewer who takes it; -> who hands it on
        std::vector<int> queue = {from};
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const int reviewer = queue[head];
            for (const bool couple : {false, true}) {
                for (const int author : order_) {
                    if (taken_from[static_cast<std::size_t>(author)] >= 0 || !board_.free(reviewer, author)) continue;
                    if (board_.any(author, reviewer) != couple) continue;
                    taken_from[static_cast<std::size_t>(author)] = reviewer;
                    if (ends(author)) {
                        follow(author, from, taken_from, submitted_by);
                        return true;
                    }
                    for (const int other : order_)
                        if (board_.loose(other, author) && other != from &&
                            submitted_by[static_cast<std::size_t>(other)] < 0) {
                            submitted_by[static_cast<std::size_t>(other)] = author;
                            queue.push_back(other);
                        }
                }
            }
        }
        return false;
    }

    void follow(int author, int from, const std::vector<int>& taken_from, const std::vector<int>& submitted_by) {
        for (int reviewer = taken_from[static_cast<std::size_t>(author)];;) {
            board_.add(reviewer, author);
            if (reviewer == from) return;
            author = submitted_by[static_cast<std::size_t>(reviewer)];
            board_.remove(reviewer, author);
            reviewer = taken_from[static_cast<std::size_t>(author)];
        }
    }

    /// One more review for the report of `author`, from the reviewer with the fewest.
    bool extend_backwards(int author, int max_reviews) {
        int best = -1;
        for (const int reviewer : order_)
            if (board_.free(reviewer, author) && board_.writes(reviewer) < max_reviews &&
                (best < 0 || rank(reviewer, author) < rank(best, author)))
                best = reviewer;
        if (best >= 0) board_.add(best, author);
        return best >= 0;
    }
    int rank(int reviewer, int author) const { return 2 * board_.writes(reviewer) + couples(reviewer, author); }

    void avoid_swaps() {
        std::vector<ReviewEdge> pairs = loose_pairs();
        for (bool better = true; better;) {
            better = false;
            for (ReviewEdge& one : pairs) {
                if (!board_.any(one.second, one.first)) continue;
                const std::size_t start = draw_(pairs.size());
                for (std::size_t k = 0; k < pairs.size(); ++k) {
                    ReviewEdge& other = pairs[(start + k) % pairs.size()];
                    if (&other != &one && exchange(one, other, true)) {
                        better = true;
                        break;
                    }
                }
            }
        }
    }

    Allocation result() const {
        Allocation allocation;
        allocation.pairs = problem_.fixed;
        std::sort(allocation.pairs.begin(), allocation.pairs.end());
        for (const ReviewEdge& pair : loose_pairs()) allocation.pairs.push_back(pair);
        for (int a = 0; a < board_.size(); ++a)
            for (int b = a + 1; b < board_.size(); ++b) allocation.swapped += board_.any(a, b) && board_.any(b, a);
        for (const int i : order_) allocation.open_reviews += std::max(0, problem_.reviews - board_.writes(i));
        explain(allocation);
        return allocation;
    }

    void explain(Allocation& allocation) const {
        const auto say = [&](const Message& sentence) { allocation.remarks.push_back(sentence); };
        if (requested_ < problem_.reviews)
            say(Message(
                "The number of remaining groups is {}, so each group can write at most {} of the {} requested reviews.",
                order_.size(), requested_, problem_.reviews));
        int few_written = 0, few_got = 0, more = 0;
        for (const int i : order_) {
            few_written += board_.writes(i) < requested_;
            few_got += board_.gets(i) < requested_;
            more += board_.writes(i) > requested_ || board_.gets(i) > requested_;
        }
        if (few_written + few_got > 0)
            say(Message(
                "Groups that write too few reviews: {}. Reports that receive too few reviews: {}. The requested number "
                "of reviews is {}, but common members and existing reviews allow no other allocation.",
                few_written, few_got, requested_));
        if (more > 0)
            say(
                Message("Groups that write or receive one extra review: {}. The requested number of reviews is {}, but "
                        "existing reviews and sent copies are kept.",
                        more, requested_));
        if (allocation.swapped > 0)
            say(plural(allocation.swapped,
                       "{} pair of groups review each other; no exchange of two reviews avoids this.",
                       "{} pairs of groups review each other; no exchange of two reviews avoids this."));
    }

    const AllocationProblem& problem_;
    Board board_;
    const UniformDraw& draw_;
    std::vector<int> order_;
    int requested_ = 0;
};

}  // namespace

Allocation allocate_reviews(const AllocationProblem& problem, const UniformDraw& draw) {
    return Allocator(problem, draw).run();
}

}  // namespace dynlab::inline course
