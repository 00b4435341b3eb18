#include "api/simulate/rig.h"

#include <algorithm>

#include "api/catalogue/catalogue_parts.h"
#include "api/json/request_limits.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "model/flow/series.h"
#include "model/flow/tube.h"

namespace plenum::api {
namespace {

// A line under construction: elements are added from source to actuator.
class LineBuilder {
 public:
  void Add(const model::FlowElement& fill, const model::FlowElement& exhaust) {
    line_.fill.push_back(fill);
    line_.exhaust.insert(line_.exhaust.begin(), exhaust);
  }
  void AddPair(Reader& reader) {
    const model::FlowElement fill = ReadPair(reader);
    model::FlowElement exhaust = fill;
    if (auto other = reader.OptionalObject("exhaust")) {
      exhaust = ReadPair(*other);
      other->Finish();
    }
    Add(fill, exhaust);
  }
  void AddTube(double inner_diameter_m, double length_m) {
    const model::FlowElement tube = model::TubeElement(inner_diameter_m, length_m);
    Add(tube, tube);
    line_.bore_volume_m3 += model::BoreVolume(inner_diameter_m, length_m);
  }
  void AddTube(Reader tube) {
    const double bore_m = MFromMm(tube.Number("inner_diameter_mm", {0.3, 30}));
    const double length_m = tube.Number("length_m", TubeLengthRange());
    tube.Finish();
    AddTube(bore_m, length_m);
  }
  void AddPart(Reader& reader, const std::vector<catalog::Part>& parts) {
    const std::string id = reader.Text("part");
    const auto length_m = reader.OptionalNumber("length_m", TubeLengthRange());
    const auto part = std::find_if(parts.begin(), parts.end(),
                                   [&](const catalog::Part& row) { return row.id == id; });
    if (part == parts.end()) {
      std::vector<std::string> ids;
      ids.reserve(parts.size());
      for (const catalog::Part& row : parts) ids.push_back(row.id);
      const std::string nearest = Nearest(id, ids);
      if (!id.empty())
        reader.Fail("part", "no part " + Quoted(id) + " in the catalogue" +
                                (nearest.empty() ? "" : "; nearest id: " + nearest));
    } else if (part->family == "tubing") {
      if (!length_m) reader.Fail("length_m", "is required for a tube of the catalogue");
      AddTube(MFromMm(part->numbers.at("inner_diameter_mm").value), length_m.value_or(1.0));
    } else if (part->family == "fitting") {
      const auto element = ElementOf(*part, "sonic_conductance_dm3_per_s_bar", "critical_ratio");
      Add(element, element);
    } else if (part->family == "valve") {
      const auto exhaust =
          ElementOf(*part, "sonic_conductance_exhaust_dm3_per_s_bar", "critical_ratio_exhaust");
      const bool only_vents = ValveKindFromFunction(part->texts.at("function").value) ==
                              model::ValveKind::kVent;  // the source feeds the line past it
      if (only_vents)
        line_.exhaust.insert(line_.exhaust.begin(), exhaust);
      else
        Add(ElementOf(*part, "sonic_conductance_fill_dm3_per_s_bar", "critical_ratio_fill"),
            exhaust);
    } else {
      reader.Fail("part", Quoted(id) + " is a " + part->family +
                              "; a line takes parts of tubing, fitting or valve");
    }
  }
  Line Take() { return std::move(line_); }

 private:
  Line line_;
};

// What stands around a source.
struct Surroundings {
  const model::Ambient& ambient;
  Side side;

  Range Pressures() const {
    return side == Side::kVacuum ? Range{DeepestKpaGauge(ambient), 0} : Range{0, kRigGaugeMaxKpa};
  }
  double Pa(double kpa_gauge) const { return PaFromKpaGauge(kpa_gauge, ambient, side); }
};

model::ReservoirSource ReadCompressor(Reader& source, const Surroundings& around) {
  model::ReservoirSource reservoir;
  reservoir.compressor = ReadPumpCurve(source, around.ambient, around.side);
  reservoir.duty = source.Number("duty", {0, 1}, 1.0);
  reservoir.volume_m3 = M3FromMl(source.Number("reservoir_volume_ml", {1, 1e6}));
  reservoir.compressor_count = source.Integer("count", 1, kCountMax, 1);
  reservoir.initial_pressure_pa =
      around.Pa(source.Number("initial_pressure_kpa_gauge", around.Pressures(), 0.0));
  if (const auto stop = source.OptionalNumber("stop_pressure_kpa_gauge", around.Pressures()))
    reservoir.stop_pressure_pa = around.Pa(*stop);
  return reservoir;
}

model::PumpSource ReadDirectPump(Reader& source, const Surroundings& around) {
  model::PumpSource pumps;
  pumps.compressor = ReadPumpCurve(source, around.ambient, around.side);
  pumps.duty = source.Number("duty", {0, 1}, 1.0);
  pumps.compressor_count = source.Integer("count", 1, kCountMax, 1);
  return pumps;
}

model::ReservoirSource ReadTank(Reader& source, const Surroundings& around) {
  model::ReservoirSource tank;
  tank.volume_m3 = M3FromMl(source.Number("reservoir_volume_ml", {1, 1e6}));
  tank.initial_pressure_pa =
      around.Pa(source.Number("initial_pressure_kpa_gauge", around.Pressures()));
  return tank;
}

model::RegulatedSource ReadRegulated(Reader& source, const Surroundings& around) {
  model::RegulatedSource regulated;
  regulated.pressure_pa = around.Pa(source.Number("source_pressure_kpa_gauge", around.Pressures()));
  if (around.side == Side::kVacuum) return regulated;
  if (auto regulator = source.OptionalObject("regulator")) {
    regulated.regulator = ReadPair(*regulator);
    regulator->Finish();
  }
  if (const auto flow = source.OptionalNumber("flow_l_per_min_anr_max", Above(0, 1e6)))
    regulated.flow_max_m3_per_s = M3PerSFromLPerMin(*flow);
  return regulated;
}

}  // namespace

Line ReadLine(Reader& group, const std::vector<catalog::Part>& parts) {
  LineBuilder builder;
  Reader line = group.Object("line");
  if (line.Has("elements")) {
    for (const Element& element : line.List("elements", 1, model::kMaxSeriesElements)) {
      Reader reader(element, group.errors());
      if (reader.Has("part"))
        builder.AddPart(reader, parts);
      else if (reader.Has("tube"))
        builder.AddTube(reader.Object("tube"));
      else
        builder.AddPair(reader);
      reader.Finish();
    }
  } else {
    builder.AddPair(line);
    if (line.Has("tube")) builder.AddTube(line.Object("tube"));
  }
  line.Finish();
  return builder.Take();
}

model::Source ReadSource(Reader& request, const model::Ambient& ambient, Side side) {
  Reader source = request.Object("source");
  const Surroundings around{ambient, side};
  const std::string kind = source.Choice(
      "kind",
      side == Side::kVacuum
          ? std::vector<std::string>{"regulated", "vacuum_pump", "direct_vacuum_pump", "none"}
          : std::vector<std::string>{"regulated", "compressor", "direct_pump", "tank", "none"});
  model::Source result = model::NoSource{};
  if (kind == "regulated") result = ReadRegulated(source, around);
  if (kind == "compressor" || kind == "vacuum_pump") result = ReadCompressor(source, around);
  if (kind == "direct_pump" || kind == "direct_vacuum_pump")
    result = ReadDirectPump(source, around);
  if (kind == "tank") result = ReadTank(source, around);
  if (!kind.empty()) source.Finish();
  return result;
}

model::Gas ReadGas(Reader& owner) {
  const auto& names = model::kGasNames;
  const std::string gas = owner.Choice("gas", {names.begin(), names.end()}, "air");
  const auto named = std::find(names.begin(), names.end(), gas);
  return named == names.end() ? model::Gas::kAir : static_cast<model::Gas>(named - names.begin());
}

model::ValveState ReadValveState(Reader& command) {
  const std::string state = command.Choice("state", {"hold", "inflate", "deflate"});
  if (state == "inflate") return model::ValveState::kInflate;
  if (state == "deflate") return model::ValveState::kDeflate;
  return model::ValveState::kHold;
}

std::optional<Schedule> ReadSchedule(Reader& owner) {
  if (owner.Has("valve") && owner.Has("cycle"))
    owner.Fail("cycle", "give either valve or cycle, not both");
  if (owner.Has("valve")) {
    Schedule schedule;
    double last_s = 0.0;
    for (const Element& element : owner.List("valve", 0, kCommandsMax)) {
      Reader command(element, owner.errors());
      const double time_s = command.Number("t_s", {0, kTimeMaxS});
      if (time_s < last_s)
        command.Fail("t_s", "must not fall from command to command: " + Decimal(time_s) +
                                " follows " + Decimal(last_s));
      schedule.commands.push_back({time_s, ReadValveState(command)});
      command.Finish();
      last_s = time_s;
    }
    return schedule;
  }
  if (auto cycle = owner.OptionalObject("cycle")) {
    const double frequency_hz = cycle->Number("frequency_hz", FrequencyRange());
    const double fraction = cycle->Number("inflate_fraction", {0, 1, true, true});
    const int cycles = cycle->Integer("cycles", 1, static_cast<int>(kCommandsMax) / 2);
    cycle->Finish();
    return Schedule{model::CycleSchedule(frequency_hz, fraction, cycles), cycles / frequency_hz};
  }
  return std::nullopt;
}

}  // namespace plenum::api
