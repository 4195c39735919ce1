#pragma once
#include <cstddef>
#include <vector>
namespace tbb {
struct simple_partitioner {};
template <class T>
class blocked_range {
  public:
    blocked_range(T b, T e, std::size_t = 1) : b_(b), e_(e) {}
    T begin() const { return b_; }
    T end() const { return e_; }

  private:
    T b_, e_;
};
template <class I, class F>
void parallel_for(I first, I last, const F& f) {
    for (I i = first; i < last; ++i) f(i);
}
template <class I, class F>
void parallel_for(I first, I last, const F& f, simple_partitioner) {
    for (I i = first; i < last; ++i) f(i);
}
template <class T, class F>
void parallel_for(const blocked_range<T>& r, const F& f, simple_partitioner = {}) {
    for (T i = r.begin(); i < r.end(); ++i) f(blocked_range<T>(i, i + 1));
}
template <class... F>
void parallel_invoke(const F&... f) {
    (f(), ...);
}
namespace info {
inline int default_concurrency() {
    return 1;
}
}
namespace this_task_arena {
template <class F>
auto isolate(const F& f) {
    return f();
}
inline int max_concurrency() {
    return 1;
}
}
struct task_arena {
    static constexpr int automatic = -1;
    explicit task_arena(int = automatic) {}
    template <class F>
    auto execute(const F& f) {
        return f();
    }
};
template <class T>
class enumerable_thread_specific {
  public:
    template <class F>
    explicit enumerable_thread_specific(F f) : value_(f()) {}
    T& local() { return value_; }

  private:
    T value_;
};
}
