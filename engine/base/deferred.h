#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

namespace dynlab::inline base {

/// A value that is computed when it is first read, by whichever thread reads it; copies share it. What the computation
/// captured is freed afterwards. One that throws is tried again by the next reader.
template <class T>
class Deferred {
  public:
    Deferred() = default;  ///< of T{}
    Deferred(T value) : state_(std::make_shared<State>()) { state_->value = std::move(value); }
    static Deferred later(std::function<T()> compute) {
        Deferred deferred;
        deferred.state_ = std::make_shared<State>();
        deferred.state_->compute = std::move(compute);
        return deferred;
    }

    const T& get() const {
        static const T nothing{};
        if (!state_) return nothing;
        const std::scoped_lock lock(state_->mutex);
        if (state_->compute) {
            state_->value = state_->compute();
            state_->compute = nullptr;
        }
        return state_->value;
    }
    /// The value where it was computed, else nothing.
    const T* known() const {
        if (!state_) return &get();
        const std::scoped_lock lock(state_->mutex);
        return state_->compute ? nullptr : &state_->value;
    }
    /// To be changed, before copies are made.
    T& edit() {
        if (!state_) state_ = std::make_shared<State>();
        return const_cast<T&>(get());
    }

  private:
    struct State {
        std::mutex mutex = {};
        std::function<T()> compute = {};
        T value = {};
    };
    std::shared_ptr<State> state_;
};

}  // namespace dynlab::inline base
