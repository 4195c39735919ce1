#pragma once
#include <memory>
#include <vector>

#include "numerics/linalg/types.h"
#include "numerics/signals/iddata.h"

namespace dynlab::inline numerics {

/// The steps of a filter over a signal sampled at rising instants t. The input u(t - delay) is zero before its first
/// sample, and held or linearly interpolated between samples. Each step leads from one sampling instant, or change of
/// the delayed input between two, to the next, from the first sample to the last. The steps form blocks of eight
/// stretches. Steps that run side by side are adjacent in memory, and those that fill up the last block have length
/// zero.
struct IrregularEvents {
    static constexpr Index kSideBySide = 8, kStretch = 32;  // steps of a stretch, one behind the other
    static constexpr Index kBlock = kSideBySide * kStretch;

    Vector length;              ///< s
    Vector input, slope;        ///< at the beginning; slopes (1/s) with linear interpolation only
    std::vector<Index> sample;  ///< that is reached, -1 for none
    Index count = 0;            ///< a multiple of kBlock

    IrregularEvents(const VectorView& u, const VectorView& t, Hold hold, double delay);

  private:
    void reserve(Index max_count, bool slopes);
    template <bool kSlopes>
    void set(const VectorView& u, const VectorView& t, double delay);
    template <bool kSlopes>
    void merge(const VectorView& u, const VectorView& t, double delay);
    template <bool kSlopes>
    void add_samples(const VectorView& u, const VectorView& t);
    template <bool kSlopes>
    void add(double seconds, double value, double rise, Index reached);
};

/// The events of a signal that a search filters repeatedly. Each thread caches its last few, with the arguments as the
/// key, except for long signals, whose events would take too much memory.
std::shared_ptr<const IrregularEvents> recent_events(const VectorView& u, const VectorView& t, Hold hold, double delay);

/// u(t - delay) at the instants t.
Vector delayed_input(const VectorView& u, const VectorView& t, Hold hold, double delay);

}  // namespace dynlab::inline numerics
