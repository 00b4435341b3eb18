#include "api/json/shared_fields.h"

#include <algorithm>
#include <cmath>

#include "api/json/remarks.h"
#include "api/json/units.h"
#include "api/json/words.h"

namespace plenum::api {

Table ReadTable(Reader& owner, std::string_view list, std::size_t least, std::string_view x_name,
                Range x_range, std::string_view y_name, Range y_range, int direction) {
  Table table;
  Errors& errors = owner.errors();
  const std::size_t errors_before = errors.size();
  for (const Element& element : owner.List(list, least, kTablePointsMax)) {
    Reader point(element, errors);
    const double x = point.Number(x_name, x_range);
    const double y = point.Number(y_name, y_range);
    point.Finish();
    if (!table.x.empty() && x <= table.x.back())
      point.Fail(x_name, "must rise from point to point: " + Decimal(x) + " follows " +
                             Decimal(table.x.back()));
    if (!table.y.empty() && direction * (y - table.y.back()) < 0)
      point.Fail(y_name, std::string("must not ") + (direction > 0 ? "fall" : "rise") +
                             " from point to point: " + Decimal(y) + " follows " +
                             Decimal(table.y.back()));
    table.x.push_back(x);
    table.y.push_back(y);
  }
  table.valid = !table.x.empty() && errors.size() == errors_before;
  return table;
}

void TellAmbient(const model::Ambient& ambient) {
  if (auto* remarks = RemarkRecorder::Current())
    remarks->SetAmbient(ambient.pressure_pa / kPaPerKpa);
}

model::Ambient ReadAmbient(Reader& request) {
  model::Ambient ambient;
  TellAmbient(ambient);
  auto reader = request.OptionalObject("ambient");
  if (!reader) return ambient;
  ambient.pressure_pa = PaFromKpaAbs(reader->Number("pressure_kpa_abs", {20, 200}, 100));
  ambient.temperature_k = reader->Number("temperature_k", {200, 350}, ambient.temperature_k);
  reader->Finish();
  // Told of once: what is gauge is read beside the usual one.
  if (std::isnan(ambient.pressure_pa)) ambient.pressure_pa = model::Ambient{}.pressure_pa;
  TellAmbient(ambient);
  return ambient;
}

Fractions ReadFractions(Reader& request) {
  Fractions fractions;
  if (auto rise = request.OptionalObject("rise")) {
    fractions.rise = rise->Number("to_fraction", Above(0, 1), fractions.rise);
    rise->Finish();
  }
  if (auto fall = request.OptionalObject("fall")) {
    fractions.fall = fall->Number("to_fraction", Below(0, 1), fractions.fall);
    fall->Finish();
  }
  return fractions;
}

model::FlowElement ReadPair(Reader& reader) {
  model::FlowElement element;
  element.sonic_conductance_m3_per_s_pa =
      ConductanceFromDm3PerSBar(reader.Number("sonic_conductance_dm3_per_s_bar", {1e-6, 1e4}));
  element.critical_ratio = reader.Number("critical_ratio", {0, 0.95});
  return element;
}

std::string ReadName(Reader& group, std::size_t index, std::vector<std::string>& names) {
  std::string name = group.Text("name", "group " + std::to_string(index + 1));
  if (!name.empty() && std::find(names.begin(), names.end(), name) != names.end())
    group.Fail("name", "must be unique; " + Quoted(name) + " is taken by an earlier group");
  names.push_back(name);
  return name;
}

model::CompressorCurve ReadPumpCurve(Reader& source, const model::Ambient& ambient, Side side) {
  const bool vacuum = side == Side::kVacuum;
  const Range pressures = vacuum ? Range{DeepestKpaGauge(ambient), 0} : Range{0, kGaugeMaxKpa};
  Table table = ReadTable(source, "curve", 1, "pressure_kpa_gauge", pressures, "free_air_l_per_min",
                          {0, 1e6}, vacuum ? +1 : -1);
  if (vacuum) {
    std::reverse(table.x.begin(), table.x.end());
    std::reverse(table.y.begin(), table.y.end());
  }
  model::CompressorCurve curve;
  if (!table.valid || std::isnan(ambient.pressure_pa)) return curve;
  std::vector<double> pressure_pa, flow_m3_per_s;
  for (const double kpa : table.x) pressure_pa.push_back(PaFromKpaGauge(kpa, ambient, side));
  for (const double flow : table.y) flow_m3_per_s.push_back(M3PerSFromLPerMin(flow));
  curve.pressure_max_pa = pressure_pa.back();
  curve.current_a = model::MonotoneCurve({pressure_pa.front()}, {0.0});
  curve.free_air_m3_per_s = model::MonotoneCurve(std::move(pressure_pa), std::move(flow_m3_per_s));
  return curve;
}

}  // namespace plenum::api
