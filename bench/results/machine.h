#pragma once

#include <nlohmann/json.hpp>

namespace bench {

/// What figures depend on: processor, cores, memory, system, compiler and build, program's version, date.
nlohmann::ordered_json describeMachine();

}  // namespace bench
