#include "api/design/given/requirement_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "api/json/words.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

struct Words {
  std::string_view field, name, unit;
  bool at_least = false;
};

constexpr std::array kRequirementWords{
    Words{"/rise_time_s_max", "rise time", " s"},
    Words{"/fall_time_s_max", "fall time", " s"},
    Words{"/pressure_kpa_gauge_max", "highest pressure", " kPa gauge"},
    Words{"/pressure_kpa_gauge_min", "lowest pressure", " kPa gauge", true},
    Words{"/supply/vacuum/vacuum_kpa_gauge_min", "vacuum", " kPa gauge", true},
    Words{"/duty/frequency_hz", "frequency that it sustains", " Hz", true},
    Words{"/duty/actuations", "number of actuations that it lasts for", "", true},
    Words{"/supply/source_pressure_kpa_gauge_max", "source pressure", " kPa gauge"},
    Words{"/supply/tank_fill_kpa_gauge_max", "tank's fill", " kPa gauge"},
    Words{"/supply/mass_kg_max", "mass", " kg"},
    Words{"/supply/volume_l_max", "volume", " L"},
    Words{"/supply/cost_eur_max", "cost", " €"},
    Words{"/supply/mains/flow_l_per_min_anr_max", "flow of the mains", " L/min"},
    Words{"/supply/parts", "parts that can be ordered only", ""},
    Words{"/limits/compressors_max", "pumps in parallel", ""},
    Words{"/limits/batteries_max", "batteries in parallel", ""},
    Words{"/limits/cylinders_max", "bottles in parallel", ""},
    Words{"/limits/co2_max", "CO₂ bottles in parallel", ""},
    Words{"/limits/reservoirs_max", "reservoirs in parallel", ""},
    Words{"/exclude", "excluded parts", ""},
    Words{"prices", "parts with a known price only", ""}};

constexpr std::string_view kActuators = "/actuators/";
constexpr std::string_view kRequire = "/require/";

Words WordsOf(std::string_view pointer) {
  for (const Words& one : kRequirementWords)
    if (pointer.ends_with(one.field)) return one;
  return {"", pointer, ""};
}

}  // namespace

std::string Told(double number) { return Significant(number, 4); }

std::string MarginInWords(const optimizer::Margin& margin, const optimizer::Problem& problem) {
  const std::string& pointer = margin.requirement;
  const Words words = WordsOf(pointer);
  std::string name(words.name);
  if (pointer.starts_with(kActuators) && problem.groups.size() > 1)
    for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g)
      if (pointer.starts_with(optimizer::GroupPointer(problem, g) + "/")) {
        name += " of " + problem.groups[g].name;
        break;
      }
  const std::string unit(words.unit);
  const std::string achieved = std::isfinite(margin.achieved) ? "is " + Told(margin.achieved) + unit
                                                              : std::string("is not known");
  return "the " + name + " " + achieved + ", asked is " + Told(margin.required) + unit +
         (words.at_least ? " at least" : " at most");
}

Demanded DemandInWords(const std::string& pointer, const Json& request) {
  if (pointer.starts_with(kRequire)) {
    std::string family = pointer.substr(kRequire.size());
    std::replace(family.begin(), family.end(), '_', ' ');
    return {"required " + family, ""};
  }
  const Words words = WordsOf(pointer);
  Demanded demanded{std::string(words.name), std::string(words.unit)};
  if (words.field.empty() || !pointer.starts_with(kActuators)) return demanded;
  const Json group = request.value(
      Json::json_pointer(pointer.substr(0, pointer.find('/', kActuators.size()))), Json());
  if (request.at("actuators").size() > 1 && group.is_object() && group.contains("name"))
    demanded.name += " of " + group.at("name").get<std::string>();
  return demanded;
}

std::string ObjectiveInWords(double objective, const optimizer::Objective& of) {
  std::string number = Told(objective);
  if (of == optimizer::Objective{.mass_kg = 1.0}) return number + " kg";
  if (of == optimizer::Objective{.volume_l = 1.0}) return number + " L";
  if (of == optimizer::Objective{.cost_eur = 1.0}) return number + " €";
  if (of == optimizer::Objective{.energy_wh = 1.0}) return number + " Wh";
  return number;
}

std::string PartInWords(const optimizer::Choice& choice, const optimizer::Problem& problem,
                        const Rows& rows) {
  const auto row = rows.find(choice.id);
  std::string text;
  const bool is_tube = choice.family == optimizer::Family::kTubing;
  if (choice.quantity > 1 && !is_tube) text += Decimal(choice.quantity) + " × ";
  text += optimizer::Name(choice.family);
  text += row == rows.end() ? " made to measure"
                            : " " + row->second->manufacturer + " " + row->second->part_number;
  if (choice.group >= 0 && problem.groups.size() > 1)
    text += " of " + problem.groups[choice.group].name;
  return text;
}

}  // namespace plenum::api
