#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "base/deferred.h"
#include "numerics/fit/assessment.h"
#include "numerics/fit/fit.h"
#include "numerics/fit/structure_advice.h"

namespace dynlab::inline numerics {

/// What speaks against a fit, as data. Estimators do not compute it: diagnose() does, when it is read.
struct Diagnostics {
    std::optional<StructureAdvice> missed = {};
    /// Whether its errors are white, and robust standard errors; no value for long data (fit/assessment.h), and for
    /// fits with a noise model (rivc).
    std::shared_ptr<const Assessment> assessment = {};

    /// A sentence for each thing that is missed.
    std::vector<Message> warnings() const;
};

/// The diagnostics of a fit by srivc, coe, rivc, procsrivc, oe, sriv, bj or armax to these data by these options. A
/// missed structure is looked for in fits of transfer functions in continuous time.
Diagnostics diagnose(const Fit& fit, const IdData& data, const FitOptions& options);

/// The diagnostics of one fit, each computed when it is first read, by any thread. Copies share them.
class DeferredDiagnostics {
  public:
    DeferredDiagnostics() = default;  ///< of a fit without any
    explicit DeferredDiagnostics(Diagnostics known);
    /// As diagnose() takes them; `data` must not change any more. They are kept until all is computed.
    DeferredDiagnostics(Fit fit, std::shared_ptr<const IdData> data, FitOptions options);

    const std::optional<StructureAdvice>& missed() const { return missed_.get(); }
    std::shared_ptr<const Assessment> assessment() const { return assessment_.get(); }
    Diagnostics all() const { return {missed(), assessment()}; }

  private:
    Deferred<std::optional<StructureAdvice>> missed_;
    Deferred<std::shared_ptr<const Assessment>> assessment_;
};

}  // namespace dynlab::inline numerics
