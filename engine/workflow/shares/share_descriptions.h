#pragma once
#include "data_io/values/cbor_values.h"
#include "workflow/shares/spool.h"

namespace dynlab::inline workflow {

/// What lies in a spool, as data_io/values/described.h stores it.

DYNLAB_DESCRIBE(SpoolIdentity, id, purpose, program, isolation, lease_ms, grace_ms)
DYNLAB_DESCRIBE(ShareJob, kind, common, title, bytes)
DYNLAB_DESCRIBE(ShareResult, worker, node, signature, bytes, trouble)
DYNLAB_DESCRIBE(WorkerStatus, node, isolation, hands, beat, done, trouble, refused, ended)
DYNLAB_DESCRIBE(CoordinatorStatus, beat, wanted, done, given_up, lost, blamed)

}  // namespace dynlab::inline workflow
