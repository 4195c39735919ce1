#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "course/store/database.h"

namespace dynlab::inline course {

/// The tables, in an order in which each refers only to earlier ones.
const std::vector<std::string>& course_tables();

/// SQL that makes each version of the tables out of the one before, the first one out of nothing.
const std::vector<const char*>& course_steps();

/// Copies the database of a course of an earlier version to FILE.before-version-N beside it, once, N being the version
/// that it is about to get. Throws EnvironmentError where that cannot be written.
void keep_before_migration(Database& database, const std::filesystem::path& file);

/// Brings an opened course to the version of tables that `steps` end with, in one transaction; returns whether it was
/// an earlier one. Throws EnvironmentError for a course made by a newer dynlab, or for a database that is not a course;
/// it stays untouched.
bool migrate_course(Database& database, Database::Opening opening, const std::string& file,
                    const std::vector<const char*>& steps = course_steps());

}  // namespace dynlab::inline course
