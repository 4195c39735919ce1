#pragma once
namespace dynlab::inline course {

struct FolderRequest;

/// Writes what the results in the folder `out` are made with: it stands beside them as grading.json, so that no later
/// run mixes marks of two kinds. Throws EnvironmentError that tells the differences where those that are there were
/// made with something else and are not to be made again. A roster or a list of owners, which say whose work it is, may
/// be given or mended when all of the class is graded, as the gradebook is then made anew from all of it; one that is
/// missing now counts. Deadlines take points: other ones always count.
void remember_inputs(const FolderRequest& request);

}  // namespace dynlab::inline course
