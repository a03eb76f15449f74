#ifndef PETRICHOR_FILM_SCENARIO_SCHEMA_H
#define PETRICHOR_FILM_SCENARIO_SCHEMA_H

#include <string>

namespace petrichor::film {

/// Scenarios as JSON Schema (draft 7), by which editors complete keys, explain them and mark values out of
/// range. Types and ranges are those that the readers ask for; meanings are those of scenario_keys().
std::string scenario_schema();

}  // namespace petrichor::film

#endif
