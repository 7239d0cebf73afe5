// What was measured, as a person, a program or a spreadsheet reads it.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "app/measure/measurement.h"

namespace app {

// "front first", "mixed".
std::string orderText(render::Order order);

// Columns with their heads; a mode whose mass is off is marked, and the mark explained.
std::string table(std::span<const Measured> modes);
// Which to choose (best_modes.h), for people and for programs.
std::string bestTable(std::span<const Measured> modes);
nlohmann::ordered_json bestJson(std::span<const Measured> modes);
// A row a mode, its head before; figures as JSON has them, empty where it has null.
std::string csv(std::span<const Measured> modes);
// Times in seconds. Null for what is infinite, as the PSNR of the same picture is.
nlohmann::ordered_json json(const Measured& measured);

}  // namespace app
