#include "api/measure/inputs_document.h"

#include <string>
#include <utility>

#include "api/json/words.h"
#include "catalog/store/content_hash.h"

namespace plenum::api {
namespace {

constexpr const char* kValues = "values";
constexpr const char* kHash = "sha256";

// 1 and 1.0 are one number, however a client wrote it.
std::string HashOf(const Json& list) {
  Json plain = Json::array();
  for (const Json& value : list)
    plain.push_back(value.is_number() ? Json(value.get<double>()) : value);
  return catalog::Sha256(plain.dump());
}

// Calls `change` with each list of readings of a run, and its pointer in the run.
template <typename Change>
void ForLists(Json& run, const Change& change) {
  if (!run.is_object()) return;
  for (const char* name : {"t_s", "pressure_kpa_gauge"})
    if (run.contains(name)) change(run[name], std::string("/") + name);
  if (!run.contains("channels") || !run["channels"].is_object()) return;
  for (auto& [name, list] : run["channels"].items()) {
    if (name != "chambers" || !list.is_object()) change(list, "/channels/" + name);
    if (name == "chambers" && list.is_object())
      for (auto& [chamber, readings] : list.items()) {
        Json::json_pointer place("/channels/chambers");
        change(readings, (place /= chamber).to_string());
      }
  }
}

bool IsHash(const Json& list) {
  return list.is_object() && list.contains(kHash) && list[kHash].is_string();
}

// The run of that id; null without one.
const Json* RunOf(const Json& measurement, const Json& id) {
  if (!measurement.is_object() || !measurement.contains("runs")) return nullptr;
  for (const Json& run : measurement["runs"])
    if (run.is_object() && run.contains("id") && run["id"] == id) return &run;
  return nullptr;
}

}  // namespace

Json InputsOf(const Json& measurement) {
  Json inputs = measurement;
  if (!inputs.is_object() || !inputs.contains("runs")) return inputs;
  for (Json& run : inputs["runs"])
    ForLists(run, [](Json& list, const std::string&) {
      if (list.is_array() && list.size() > kInputsListed)
        list = Json{{kValues, list.size()}, {kHash, HashOf(list)}};
    });
  return inputs;
}

Parsed<Json> WithReadings(Json inputs, const Json* measurement) {
  Errors errors;
  if (!inputs.is_object() || !inputs.contains("runs") || !inputs["runs"].is_array())
    return Errors{{"/measurement", "must be the measurement of the diagnosis"}};
  std::size_t index = 0;
  for (Json& run : inputs["runs"]) {
    const std::string pointer = "/measurement/runs/" + std::to_string(index++);
    ForLists(run, [&](Json& list, const std::string& place) {
      if (!IsHash(list)) return;
      const Json* given = measurement ? RunOf(*measurement, run.value("id", Json())) : nullptr;
      const Json::json_pointer at(place);
      if (given == nullptr || !given->contains(at)) {
        errors.push_back({pointer + place,
                          "holds more values than an answer carries: give the measurement, too"});
      } else if (HashOf(given->at(at)) != list[kHash].get<std::string>()) {
        errors.push_back({pointer + place, "is not what was diagnosed: the readings of run " +
                                               Quoted(run["id"].get<std::string>()) +
                                               " have another hash"});
      } else {
        list = given->at(at);
      }
    });
  }
  if (!errors.empty()) return errors;
  return inputs;
}

}  // namespace plenum::api
