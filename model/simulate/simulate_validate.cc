#include "model/simulate/simulate_validate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <variant>

#include "model/flow/series.h"

namespace plenum::model {
namespace {

constexpr double kSamplesMax = 2e7;

// Collects the first reason; later checks are then skipped.
class Check {
 public:
  explicit Check(std::string prefix = {}) : prefix_(std::move(prefix)) {}

  void Fails(const std::string& field, const std::string& why) {
    if (reason_.empty()) reason_ = prefix_ + field + " " + why;
  }
  void Require(bool ok, const std::string& field, double value, const char* range) {
    if (ok) return;
    std::ostringstream text;
    text.precision(17);
    text << "is " << value << ", must be " << range;
    Fails(field, text.str());
  }
  void Positive(const std::string& field, double value) {
    Require(std::isfinite(value) && value > 0.0, field, value, "finite and above 0");
  }
  void NotNegative(const std::string& field, double value) {
    Require(std::isfinite(value) && value >= 0.0, field, value, "finite and at least 0");
  }
  void Element(const std::string& field, const FlowElement& element) {
    Positive(field + ".sonic_conductance_m3_per_s_pa", element.sonic_conductance_m3_per_s_pa);
    Require(element.critical_ratio >= 0.0 && element.critical_ratio < 1.0,
            field + ".critical_ratio", element.critical_ratio, "in [0, 1)");
    Require(element.subsonic_index > 0.0 && element.subsonic_index <= 1.0,
            field + ".subsonic_index", element.subsonic_index, "in (0, 1]");
    NotNegative(field + ".cracking_pressure_pa", element.cracking_pressure_pa);
  }
  void Elements(const std::string& field, const std::vector<FlowElement>& elements) {
    Require(elements.size() <= kMaxSeriesElements, field + " element count",
            static_cast<double>(elements.size()), "at most 8");
    for (std::size_t i = 0; i < elements.size(); ++i) {
      Element(field + "[" + std::to_string(i) + "]", elements[i]);
    }
  }
  const std::string& reason() const { return reason_; }

 private:
  std::string prefix_, reason_;
};

void CheckSchedule(const GroupRig& group, Check& check) {
  double before_s = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < group.schedule.size(); ++i) {
    const auto& [time_s, state] = group.schedule[i];
    const std::string field = "schedule[" + std::to_string(i) + "]";
    check.Require(std::isfinite(time_s), field + ".time_s", time_s, "finite");
    check.Require(time_s >= before_s, field + ".time_s", time_s, "no earlier than the one before");
    before_s = time_s;
    if (state == ValveState::kInflate && group.fill.empty()) {
      check.Fails("fill", "is empty, must hold an element where the schedule inflates");
    }
    if (state == ValveState::kDeflate && group.exhaust.empty()) {
      check.Fails("exhaust", "is empty, must hold an element where the schedule deflates");
    }
  }
}

void CheckCourse(const std::string& field, const std::vector<double>& time_s,
                 const std::vector<double>& value, Check& check) {
  if (value.size() != time_s.size()) check.Fails(field, "must hold as many points as time_s");
  double before_s = -std::numeric_limits<double>::infinity();
  for (const double at_s : time_s) {
    check.Require(std::isfinite(at_s) && at_s > before_s, "time_s", at_s,
                  "finite and above the one before");
    before_s = at_s;
  }
}

void CheckTold(const GroupRig& group, Check& check) {
  const auto& [opening, volume_m3] = group.told;
  CheckCourse("told.opening.value", opening.time_s, opening.value, check);
  for (const double open : opening.value)
    check.Require(open >= 0.0 && open <= 1.0, "told.opening.value", open, "in [0, 1]");
  CheckCourse("told.volume_m3.value", volume_m3.time_s, volume_m3.value, check);
  for (const double m3 : volume_m3.value) check.Positive("told.volume_m3.value", m3);
  if (!volume_m3.empty() && !group.blocked)
    check.Fails("blocked", "must hold where the volume is told");
  if (group.chamber.evacuated && !(opening.empty() && volume_m3.empty()))
    check.Fails("told", "goes with no evacuated chamber");
}

std::string WhyGroupInvalid(const GroupRig& group, std::size_t index, const Ambient& ambient) {
  Check check("groups[" + std::to_string(index) + "].");
  check.Require(group.count >= 1, "count", group.count, "at least 1");
  const std::string chamber = WhyInvalid(group.chamber);
  if (!chamber.empty()) check.Fails("chamber:", chamber);
  check.Require(group.chamber.ambient_pressure_pa == ambient.pressure_pa,
                "chamber.ambient_pressure_pa", group.chamber.ambient_pressure_pa,
                "equal to ambient.pressure_pa");
  check.Elements("fill", group.fill);
  check.Elements("exhaust", group.exhaust);
  check.Positive("initial_pressure_pa", group.initial_pressure_pa);
  check.NotNegative("initial_temperature_k", group.initial_temperature_k);
  const std::string effects = WhyInvalid(group.effects);
  if (!effects.empty()) check.Fails("", effects);
  const bool restricted =
      std::any_of(group.effects.begin(), group.effects.end(),
                  [](const Effect& e) { return e.spec && e.spec->id == "exhaust_restriction"; });
  check.Require(!restricted || group.exhaust.size() < kMaxSeriesElements, "exhaust element count",
                static_cast<double>(group.exhaust.size()), "at most 7 with exhaust_restriction");
  const auto holds_inlet = [&](const std::vector<FlowElement>& line) {
    return line.empty() || group.inlet_after <= line.size();
  };
  check.Require(holds_inlet(group.fill) && holds_inlet(group.exhaust), "inlet_after",
                static_cast<double>(group.inlet_after), "at most the element count of the line");
  if (group.chamber.evacuated && (!group.effects.empty() || group.inlet_after > 0))
    check.Fails("chamber.evacuated", "goes with no effects and no inlet sensor");
  if (group.chamber.low_pressure_pa > 0.0 &&
      (!group.effects.empty() || !group.told.opening.empty()))
    check.Fails("chamber.low_pressure_pa", "goes with no effects and no told opening");
  check.Require(!group.close_at_low || group.chamber.low_pressure_pa > 0.0,
                "chamber.low_pressure_pa", group.chamber.low_pressure_pa,
                "above 0 with close_at_low");
  CheckSchedule(group, check);
  CheckTold(group, check);
  return check.reason();
}

std::string WhyLinkInvalid(const Rig& rig, std::size_t index) {
  const Link& link = rig.links[index];
  Check check("links[" + std::to_string(index) + "].");
  const std::size_t groups = rig.groups.size();
  if (link.from >= groups || link.to >= groups || link.from == link.to) {
    check.Fails("from, to", "must be two groups of the rig");
    return check.reason();
  }
  for (const std::size_t group : {link.from, link.to})
    if (rig.groups[group].count != 1 || rig.groups[group].chamber.evacuated || rig.dense)
      check.Fails("from, to", "must be single actuators with gas that is not dense, not mirrored");
  if (link.fill.empty() || link.back.empty()) check.Fails("fill, back", "must hold an element");
  check.Elements("fill", link.fill);
  check.Elements("back", link.back);
  return check.reason();
}

void CheckSource(const RegulatedSource& source, Check& check) {
  check.Positive("pressure_pa", source.pressure_pa);
  if (source.regulator) check.Element("regulator", *source.regulator);
  check.Require(source.flow_max_m3_per_s > 0.0, "flow_max_m3_per_s", source.flow_max_m3_per_s,
                "above 0");
}

// Of a reservoir's pumps, or of pumps without one.
template <class PumpedSource>
void CheckPumps(const PumpedSource& source, Check& check) {
  for (double flow : source.compressor.free_air_m3_per_s.y()) {
    check.NotNegative("compressor.free_air_m3_per_s", flow);
  }
  for (double current : source.compressor.current_a.y()) {
    check.NotNegative("compressor.current_a", current);
  }
  check.NotNegative("compressor.voltage_v", source.compressor.voltage_v);
  check.Positive("compressor.pressure_max_pa", source.compressor.pressure_max_pa);
  check.Require(source.compressor_count >= 1, "compressor_count", source.compressor_count,
                "at least 1");
  check.Require(source.duty >= 0.0 && source.duty <= 1.0, "duty", source.duty, "in [0, 1]");
}

void CheckSource(const ReservoirSource& source, Check& check) {
  check.Positive("volume_m3", source.volume_m3);
  check.NotNegative("volume_rising_m3", source.volume_rising_m3);
  check.Positive("initial_pressure_pa", source.initial_pressure_pa);
  if (source.compressor.free_air_m3_per_s.empty()) return;
  CheckPumps(source, check);
  check.Require(source.stop_pressure_pa > 0.0, "stop_pressure_pa", source.stop_pressure_pa,
                "above 0");
}

void CheckSource(const PumpSource& source, Check& check) {
  if (source.compressor.free_air_m3_per_s.empty())
    check.Fails("compressor.free_air_m3_per_s", "is empty, must hold a point");
  CheckPumps(source, check);
}

void CheckSource(const DrivenSource& source, Check& check) {
  if (source.time_s.empty()) check.Fails("time_s", "is empty, must hold a point");
  CheckCourse("pressure_pa", source.time_s, source.pressure_pa, check);
  for (const double pressure_pa : source.pressure_pa) check.Positive("pressure_pa", pressure_pa);
  check.Positive("factor", source.factor);
}

void CheckSource(const NoSource&, Check&) {}

}  // namespace

std::string WhyInvalid(const Rig& rig) {
  Check check;
  check.Positive("ambient.pressure_pa", rig.ambient.pressure_pa);
  check.Positive("ambient.temperature_k", rig.ambient.temperature_k);
  check.NotNegative("exhaust_pressure_pa", rig.exhaust_pressure_pa);
  if (rig.groups.empty()) check.Fails("groups", "is empty, must hold at least one group");
  if (!check.reason().empty()) return check.reason();

  Check source("source.");
  std::visit([&](const auto& s) { CheckSource(s, source); }, rig.source);
  if (!source.reason().empty()) return source.reason();

  for (std::size_t i = 0; i < rig.groups.size(); ++i) {
    std::string reason = WhyGroupInvalid(rig.groups[i], i, rig.ambient);
    if (!reason.empty()) return reason;
    if (rig.groups[i].chamber.evacuated && rig.exhaust_pressure_pa > 0.0)
      return "exhaust_pressure_pa is for actuators under pressure, not evacuated ones";
    if (rig.groups[i].chamber.evacuated != rig.groups[0].chamber.evacuated)
      return "groups[" + std::to_string(i) + "].chamber.evacuated: one for all groups of a rig";
    if (!std::holds_alternative<PumpSource>(rig.source)) continue;
    for (const Effect& effect : rig.groups[i].effects)
      if (effect.spec->place == EffectPlace::kSupply)
        return "groups[" + std::to_string(i) + "].effects: " + std::string(effect.spec->id) +
               " acts on a source that has a pressure of its own, not on pumps alone";
  }
  for (std::size_t i = 0; i < rig.links.size(); ++i)
    if (std::string reason = WhyLinkInvalid(rig, i); !reason.empty()) return reason;
  return {};
}

std::string WhyInvalid(const SimulateOptions& options) {
  Check check;
  check.NotNegative("end_s", options.end_s);
  check.NotNegative("sample_hz", options.sample_hz);
  check.Require(options.end_s * options.sample_hz <= kSamplesMax, "end_s * sample_hz",
                options.end_s * options.sample_hz, "at most 2e7 samples");
  double before_s = 0.0;
  for (std::size_t k = 0; k < options.sample_times_s.size(); ++k) {
    const double time_s = options.sample_times_s[k];
    check.Require(time_s >= before_s && time_s <= options.end_s,
                  "sample_times_s[" + std::to_string(k) + "]", time_s,
                  "no earlier than the one before, at least 0 and at most end_s");
    before_s = time_s;
  }
  check.Require(options.rise_fraction > 0.0 && options.rise_fraction <= 1.0, "rise_fraction",
                options.rise_fraction, "in (0, 1]");
  check.Require(options.fall_fraction >= 0.0 && options.fall_fraction < 1.0, "fall_fraction",
                options.fall_fraction, "in [0, 1)");
  check.Positive("relative_tolerance", options.relative_tolerance);
  check.Positive("absolute_tolerance_pa", options.absolute_tolerance_pa);
  check.Require(options.linear_ratio > 0.0 && options.linear_ratio < 1.0, "linear_ratio",
                options.linear_ratio, "in (0, 1)");
  return check.reason();
}

}  // namespace plenum::model
