#include "api/measure/rig_parts.h"

#include <algorithm>
#include <set>
#include <utility>

#include "api/json/words.h"

namespace plenum::api {
namespace {

constexpr const char* kConductance = "sonic_conductance_dm3_per_s_bar";
constexpr const char* kRatio = "critical_ratio";

class Filling {
 public:
  Filling(const std::vector<catalog::Part>& parts, Errors& errors)
      : parts_(parts), errors_(errors) {}

  void OfRig(Json& rig, const std::string& pointer) {
    if (!rig.is_object()) return;
    OfLine(rig, pointer);
    if (rig.contains("actuator")) OfActuator(rig["actuator"], pointer + "/actuator");
    if (rig.contains("chambers") && rig["chambers"].is_array()) {
      std::size_t i = 0;
      for (Json& chamber : rig["chambers"]) {
        const std::string place = pointer + "/chambers/" + std::to_string(i++);
        OfLine(chamber, place);
        OfActuator(chamber, place);
      }
    }
    if (rig.contains("supply")) OfSupply(rig["supply"], pointer + "/supply");
  }

 private:
  // Of the rig or of one of its chambers.
  void OfLine(Json& owner, const std::string& pointer) {
    if (!owner.is_object() || !owner.contains("line") || !owner["line"].is_object() ||
        !owner["line"].contains("elements") || !owner["line"]["elements"].is_array())
      return;
    std::size_t i = 0;
    for (Json& element : owner["line"]["elements"])
      OfElement(element, pointer + "/line/elements/" + std::to_string(i++));
  }

  void Fail(std::string pointer, std::string detail) {
    errors_.push_back({std::move(pointer), std::move(detail)});
  }

  // The part that the object names; null without a name, or with an error.
  const catalog::Part* PartOf(const Json& object, const std::string& pointer) {
    if (!object.is_object() || !object.contains("part") || !object["part"].is_string())
      return nullptr;
    const auto& id = object["part"].get_ref<const std::string&>();
    for (const catalog::Part& part : parts_)
      if (part.id == id) return &part;
    std::vector<std::string> ids;
    ids.reserve(parts_.size());
    for (const catalog::Part& part : parts_) ids.push_back(part.id);
    const std::string nearest = Nearest(id, ids);
    Fail(pointer + "/part", "no part " + Quoted(id) + " in the catalogue" +
                                (nearest.empty() ? "" : "; nearest id: " + nearest));
    return nullptr;
  }

  void RefuseFamily(const catalog::Part& part, const std::string& pointer,
                    const std::string& allowed) {
    Fail(pointer + "/part", Quoted(part.id) + " is a " + part.family + "; " + allowed);
  }

  // Puts the part's number there, unless one stands there.
  void Put(const catalog::Part& part, const char* field, Json& object, const char* name,
           const std::string& pointer) {
    if (object.contains(name)) return;
    const auto number = part.numbers.find(field);
    if (number == part.numbers.end())
      Fail(pointer + "/" + name, "is required: " + part.id + " has no " + field);
    else
      object[name] = number->second.value;
  }

  void OfElement(Json& element, const std::string& pointer) {
    const catalog::Part* part = PartOf(element, pointer);
    if (part == nullptr) return;
    if (part->family == "tubing") return OfTubing(*part, element, pointer);
    if (part->family == "valve") {
      Put(*part, "sonic_conductance_fill_dm3_per_s_bar", element, kConductance, pointer);
      Put(*part, "critical_ratio_fill", element, kRatio, pointer);
      Json& exhaust = element["exhaust"];
      if (exhaust.is_null()) exhaust = Json::object();
      if (!exhaust.is_object()) return;  // reported by the reader
      Put(*part, "sonic_conductance_exhaust_dm3_per_s_bar", exhaust, kConductance,
          pointer + "/exhaust");
      Put(*part, "critical_ratio_exhaust", exhaust, kRatio, pointer + "/exhaust");
      return;
    }
    static const std::set<std::string> kOnePair{"fitting", "regulator", "check_valve", "manifold",
                                                "silencer"};
    if (!kOnePair.contains(part->family))
      return RefuseFamily(*part, pointer,
                          "a line takes a valve, fitting, tubing, regulator, check_valve, manifold "
                          "or silencer");
    Put(*part, kConductance, element, kConductance, pointer);
    Put(*part, kRatio, element, kRatio, pointer);
  }

  void OfTubing(const catalog::Part& part, Json& element, const std::string& pointer) {
    if (element.contains("measure"))
      return Fail(pointer + "/measure", "of tubing, which has no number that a flow test fixes");
    if (!element.contains("length_m"))
      return Fail(pointer + "/length_m", "is required for a tube of the catalogue");
    Json tube = {{"length_m", element["length_m"]}};
    Put(part, "inner_diameter_mm", tube, "inner_diameter_mm", pointer);
    Json given = std::move(element);
    element = Json::object();
    element["tube"] = std::move(tube);
    for (auto& [name, value] : given.items())
      if (name != "part" && name != "length_m") element[name] = value;
  }

  void OfActuator(Json& actuator, const std::string& pointer) {
    const catalog::Part* part = PartOf(actuator, pointer);
    if (part == nullptr) return;
    if (part->family != "reservoir")
      return RefuseFamily(*part, pointer, "what is filled in a rig can be a reservoir");
    Put(*part, "internal_volume_ml", actuator, "rest_volume_ml", pointer);
    Put(*part, "pressure_max_kpa_gauge", actuator, "operating_pressure_kpa_gauge", pointer);
    if (!actuator.contains("expansion_ratio")) actuator["expansion_ratio"] = 1.0;
  }

  void OfSupply(Json& supply, const std::string& pointer) {
    const catalog::Part* part = PartOf(supply, pointer);
    if (part == nullptr) return;
    if (part->family != "compressor" || !part->curve)
      return RefuseFamily(*part, pointer, "a supply can be a compressor");
    if (supply.contains("curve")) return;
    Json& curve = supply["curve"] = Json::array();
    for (const catalog::CurvePoint& point : part->curve->points)
      curve.push_back({{"pressure_kpa_gauge", point.pressure_kpa_gauge},
                       {"free_air_l_per_min", point.free_air_l_per_min}});
  }

  const std::vector<catalog::Part>& parts_;
  Errors& errors_;
};

bool Names(const Json& value) {
  if (value.is_object() && value.contains("part")) return true;
  return value.is_structured() && std::any_of(value.begin(), value.end(), Names);
}

bool HasRuns(const Json& measurement) {
  return measurement.contains("runs") && measurement["runs"].is_array();
}

}  // namespace

bool NamesParts(const Json& measurement) {
  if (!measurement.is_object()) return false;
  if (measurement.contains("rig") && Names(measurement["rig"])) return true;
  return HasRuns(measurement) &&
         std::any_of(measurement["runs"].begin(), measurement["runs"].end(), [](const Json& run) {
           return run.is_object() && run.contains("rig") && Names(run["rig"]);
         });
}

Json WithParts(Json measurement, const std::vector<catalog::Part>& parts, Errors& errors) {
  Filling filling(parts, errors);
  if (!measurement.is_object()) return measurement;  // reported by the reader
  if (measurement.contains("rig")) filling.OfRig(measurement["rig"], "/rig");
  if (HasRuns(measurement)) {
    std::size_t i = 0;
    for (Json& run : measurement["runs"]) {
      const std::string pointer = "/runs/" + std::to_string(i++) + "/rig";
      if (run.is_object() && run.contains("rig")) filling.OfRig(run["rig"], pointer);
    }
  }
  return measurement;
}

std::string FieldOfMeasured(std::string_view name) {
  if (name == "internal_volume") return "internal_volume_ml";
  if (name.starts_with("sonic_conductance")) return std::string(name) + "_dm3_per_s_bar";
  return std::string(name);
}

}  // namespace plenum::api
