#pragma once
#include <string>
#include <vector>

#include "course/store/sqlite.h"

namespace dynlab {

/// The tables, in an order in which each refers only to earlier ones.
const std::vector<std::string>& course_tables();

/// Brings an opened course to the version of tables that this program knows, in one transaction. Throws
/// EnvironmentError for a course made by a newer dynlab, or for a database that is no course; it stays untouched.
void migrate_course(Database& database, Database::Opening opening, const std::string& place);

}  // namespace dynlab
