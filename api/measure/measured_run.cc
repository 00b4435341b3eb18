#include "api/measure/measured_run.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "api/json/remarks.h"
#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/shared_fields.h"
#include "api/json/units.h"
#include "api/json/words.h"
#include "api/measure/measured_rig.h"
#include "api/measure/rig/several_chambers.h"
#include "api/measure/valve/measured_valve.h"
#include "calibration/values/crossing.h"

namespace plenum::api {
namespace {

using calibration::MeasuredNumber;
using calibration::MeasuredPlace;
using calibration::Run;
using calibration::Supply;

constexpr std::size_t kReadingsMin = 8;
constexpr std::size_t kSpecimenCharactersMax = 100;
constexpr double kAbsurd = 3.0;  // a reading that many times above all that could cause it

// Collects errors of one list up to a number, then says how many more there are.
class SeriesErrors {
 public:
  SeriesErrors(Reader& owner, std::string name) : owner_(owner), name_(std::move(name)) {}
  ~SeriesErrors() {
    if (count_ > kSeriesErrors)
      owner_.Fail(name_, "and " + std::to_string(count_ - kSeriesErrors) + " more like these");
  }
  SeriesErrors(const SeriesErrors&) = delete;
  void Add(std::size_t index, const std::string& detail) {
    if (++count_ <= kSeriesErrors) owner_.FailAt(name_ + "/" + std::to_string(index), detail);
  }

 private:
  Reader& owner_;
  std::string name_;
  std::size_t count_ = 0;
};

// Samples; null is NaN where `gaps` are allowed.
std::vector<double> ReadSeries(Reader& owner, const std::string& name, Range range, bool gaps,
                               std::size_t least) {
  Json item = NumberForm(range);
  if (gaps) item = {{"anyOf", {item, {{"type", "null"}}}}};
  owner.Describe(name, {{"type", "array"},
                        {"minItems", least},
                        {"maxItems", kRunSamplesMax},
                        {"items", std::move(item)}});
  std::vector<double> series;
  SeriesErrors errors(owner, name);
  for (const Element& element : owner.List(name, least, kRunSamplesMax)) {
    const Json& value = *element.value;
    double number = kNaN;
    if (value.is_number()) {
      number = value.get<double>();
      if (!range.Contains(number))
        errors.Add(series.size(), "must be " + range.Text() + ", not " + Decimal(number));
    } else if (!value.is_null() || !gaps) {
      errors.Add(series.size(), "must be a number" + std::string(gaps ? " or null" : "") +
                                    ", not " + KindOf(value));
    }
    series.push_back(number);
  }
  return series;
}

void CheckRising(Reader& owner, const std::vector<double>& t_s) {
  SeriesErrors errors(owner, "t_s");
  for (std::size_t i = 1; i < t_s.size(); ++i)
    if (t_s[i] < t_s[i - 1])
      errors.Add(i, "must not fall from sample to sample: " + Decimal(t_s[i]) + " follows " +
                        Decimal(t_s[i - 1]));
  if (!t_s.empty() && t_s.front() == t_s.back())
    owner.Fail("t_s", "must span some time; all samples are at " + Decimal(t_s.front()) + " s");
}

void CheckLength(Reader& owner, const std::string& name, std::size_t length, std::size_t samples) {
  if (length > 0 && samples > 0 && length != samples)
    owner.Fail(name, "must have one value for each of the " + std::to_string(samples) +
                         " sample times, not " + std::to_string(length));
}

std::vector<double> InSi(const std::vector<double>& series, auto&& convert) {
  std::vector<double> si(series.size());
  std::transform(series.begin(), series.end(), si.begin(), convert);
  return si;
}

// Most that a reading may be: what looks like pascals on a rig that is no such is refused.
double HighestKpa(const Run& run) {
  const double declared_pa = std::max(run.chamber.operating_pressure_pa, run.source_pressure_pa);
  return declared_pa > kGaugeMaxKpa * kPaPerKpa ? kRigGaugeMaxKpa : kGaugeMaxKpa;
}

// Gives the readings of other chambers.
ChamberReadings ReadChannels(Reader& owner, Run& run) {
  auto channels = owner.OptionalObject("channels");
  if (!channels) return ChamberReadings(run.several.all.size());
  const double lowest_kpa = -run.ambient.pressure_pa / kPaPerKpa;
  const auto gauge = [&](double kpa) { return PaFromKpaGauge(kpa, run.ambient); };
  const auto read_of = [&](Reader& of, const std::string& name, Range range, auto&& convert) {
    std::vector<double> channel = InSi(ReadSeries(of, name, range, true, 0), convert);
    CheckLength(of, name, channel.size(), run.t_s.size());
    const bool silent =
        std::all_of(channel.begin(), channel.end(), [](double value) { return std::isnan(value); });
    if (silent) channel.clear();
    return channel;
  };
  const auto read = [&](const char* name, Range range, auto&& convert,
                        std::vector<double>& channel) {
    if (channels->Has(name)) channel = read_of(*channels, name, range, convert);
  };
  const Range pressure = Above(lowest_kpa, HighestKpa(run));
  read("source_pressure_kpa_gauge", pressure, gauge, run.channels.source_pressure_pa);
  read("inlet_pressure_kpa_gauge", pressure, gauge, run.channels.inlet_pressure_pa);
  read("temperature_k", {50, 2000}, std::identity(), run.channels.temperature_k);
  read("volume_ml", Above(0, 1e9), M3FromMl, run.channels.volume_m3);
  read("flow_l_per_min_anr", {-1e6, 1e6}, M3PerSFromLPerMin, run.channels.flow_m3_per_s);
  read("valve_opening", {0, 1}, std::identity(), run.channels.valve_opening);
  read("source_setpoint_kpa_gauge", {0, HighestKpa(run)}, gauge, run.channels.source_setpoint_pa);
  const Range readings = {1.5 * lowest_kpa, HighestKpa(run)};
  ChamberReadings chambers = ReadChamberChannels(
      *channels, run.several,
      [&](Reader& of, const std::string& name) { return read_of(of, name, readings, gauge); });
  channels->Finish();
  return chambers;
}

double Largest(const std::vector<double>& series) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double value : series)
    if (value > largest) largest = value;
  return largest;
}

// How the volume goes: with the pressure, or as its channel says.
void ReadVolume(Reader& owner, Run& run) {
  run.blocked = owner.Bool("blocked", false);
  run.volume_imposed = owner.Choice("volume", {"free", "imposed"}, "free") == "imposed";
  if (!run.volume_imposed) return;
  if (run.blocked) owner.Fail("blocked", "must be left out where volume is imposed");
  run.blocked = true;
  for (const MeasuredPlace& place : run.measured.places)
    if (place.of == MeasuredPlace::Of::kVolume)
      owner.Fail("volume", "must be free where the rig measures internal_volume");
}

// What drives the run must be recorded, and have something to drive.
void CheckDriven(Reader& owner, Run& run) {
  if (run.volume_imposed && run.channels.volume_m3.empty())
    owner.Fail("channels", "volume_ml is required where volume is imposed");
  if (run.channels.source_setpoint_pa.empty()) return;
  if (run.supply == Supply::kRegulated) {
    if (!calibration::Evacuates(run))
      run.source_pressure_pa = Largest(run.channels.source_setpoint_pa);
    return;
  }
  run.channels.source_setpoint_pa.clear();
  if (RemarkRecorder::Current() != nullptr)
    RemarkRecorder::Current()->Warn(owner.Pointer("channels") + "/source_setpoint_kpa_gauge",
                                    "is not used: it drives a source of supply.kind regulated");
}

void ReadInitial(Reader& owner, Run& run) {
  auto initial = owner.OptionalObject("initial");
  if (!initial) return;
  const double lowest_kpa = -run.ambient.pressure_pa / kPaPerKpa;
  if (const auto kpa =
          initial->OptionalNumber("pressure_kpa_gauge", Above(lowest_kpa, HighestKpa(run))))
    run.initial_pressure_pa = PaFromKpaGauge(*kpa, run.ambient);
  run.initial_temperature_k = initial->OptionalNumber("temperature_k", {150, 600});
  initial->Finish();
}

bool Opens(const Run& run, model::ValveState state) {
  return std::any_of(run.valve.begin(), run.valve.end(),
                     [&](const model::ValveCommand& command) { return command.state == state; });
}

// An evacuated actuator is evacuated by a source below ambient, and something of its volume is left
// at the deepest pressure.
void CheckEvacuated(Reader& owner, const Run& run, const model::Chamber& chamber, bool inflates,
                    bool has_source_pressure) {
  if (!model::Shrinks(chamber)) return;
  const std::string below = " where the actuator's operating_pressure_kpa_gauge is below 0";
  if (run.volume_imposed) owner.Fail("volume", "must be free" + below);
  if (inflates && run.supply != Supply::kRegulated)
    owner.Fail("valve", "inflates, which needs supply.kind regulated" + below);
  else if (inflates && has_source_pressure && !calibration::Evacuates(run))
    owner.Fail("source_pressure_kpa_gauge",
               "must be below 0" + below + ": to inflate is to evacuate");
  const double least = calibration::ExpansionRange(run, chamber).first;
  if (run.blocked || !(chamber.expansion_ratio < least)) return;
  const double deepest_pa =
      std::min(calibration::LowestPressure(run), chamber.operating_pressure_pa);
  owner.Fail("rig", "nothing would be left of the actuator's volume at " +
                        Decimal(Rounded(KpaGaugeFromPa(deepest_pa, run.ambient))) +
                        " kPa gauge, to which this run goes: expansion_ratio must be at least " +
                        Decimal(Rounded(least)) +
                        ", or operating_pressure_kpa_gauge the deepest pressure of all runs with "
                        "the ratio there");
}

// What the run does must be possible with what is declared.
void CheckAgreement(Reader& owner, const Run& run, bool has_source_pressure) {
  const bool inflates = Opens(run, model::ValveState::kInflate);
  if ((inflates || Opens(run, model::ValveState::kDeflate)) && run.line.empty())
    owner.Fail("valve", "opens, but the rig has no line");
  if (inflates && run.supply == Supply::kNone)
    owner.Fail("valve", "inflates, but the rig's supply is none");
  if (run.supply == Supply::kRegulated && inflates && !has_source_pressure)
    owner.Fail("source_pressure_kpa_gauge",
               "is required with a regulated supply, a number, or its setpoint as the channel "
               "source_setpoint_kpa_gauge");
  if (run.several.empty()) CheckEvacuated(owner, run, run.chamber, inflates, has_source_pressure);
  for (std::size_t i = run.several.first(); i < run.several.all.size(); ++i)
    CheckEvacuated(owner, run, run.several.all[i].chamber, inflates, has_source_pressure);
  const calibration::Channels& channels = run.channels;
  if (calibration::Evacuates(run) &&
      !(channels.source_pressure_pa.empty() && channels.flow_m3_per_s.empty() &&
        channels.source_setpoint_pa.empty()))
    owner.Fail("channels",
               "must not hold source_pressure_kpa_gauge, source_setpoint_kpa_gauge or "
               "flow_l_per_min_anr where source_pressure_kpa_gauge of the run is below 0");
  if (run.supply == Supply::kMeasured && run.channels.source_pressure_pa.empty())
    owner.Fail("channels", "source_pressure_kpa_gauge is required with supply.kind measured");
}

// The run's measured numbers, by their place among those of all runs.
void TakeMeasured(const std::vector<MeasuredInRig>& rig, std::vector<MeasuredNumber>& measured,
                  Run& run) {
  for (const MeasuredInRig& one : rig) {
    const auto known =
        std::find_if(measured.begin(), measured.end(), [&](const MeasuredNumber& other) {
          return other.part == one.number.part && other.name == one.number.name &&
                 other.pressure_pa == one.number.pressure_pa;
        });
    const auto number = static_cast<std::size_t>(known - measured.begin());
    if (known == measured.end()) measured.push_back(one.number);
    for (MeasuredPlace place : one.places) {
      place.number = number;
      run.measured.places.push_back(place);
    }
    if (one.number.kind == MeasuredNumber::Kind::kDelivery) run.measured.delivery.push_back(number);
  }
}

// The name of the piece of the actuator; empty where the run names none.
std::string ReadSpecimen(Reader& owner) {
  owner.Describe("specimen",
                 {{"type", "string"}, {"minLength", 1}, {"maxLength", kSpecimenCharactersMax}});
  if (!owner.Has("specimen")) return "";
  const Json* given = owner.Raw("specimen");
  if (!given->is_string()) {
    owner.Fail("specimen", "must be the name of the piece of the actuator that was measured, not " +
                               KindOf(*given));
    return "";
  }
  const auto& name = given->get_ref<const std::string&>();
  const std::size_t length = CountCharacters(name);
  if (length < 1 || length > kSpecimenCharactersMax)
    owner.Fail("specimen", "must have 1 to " + std::to_string(kSpecimenCharactersMax) +
                               " characters, not " + std::to_string(length) +
                               "; leave it out where all runs are of one piece");
  return name;
}

// Of the name among those of earlier runs, which it joins.
std::size_t PlaceOf(const std::string& name, std::vector<std::string>& names) {
  const auto known = std::find(names.begin(), names.end(), name);
  const auto place = static_cast<std::size_t>(known - names.begin());
  if (known == names.end()) names.push_back(name);
  return place;
}

// By how much an imposed volume alone can raise a pressure.
double SqueezeOf(const Run& run) {
  double least = std::numeric_limits<double>::infinity();
  for (const double m3 : run.channels.volume_m3)
    if (m3 < least) least = m3;
  return Largest(run.channels.volume_m3) / least;
}

// Readings that can tell something; `field` is where they stand.
void CheckReadings(Reader& owner, const std::string& field, const Run& run) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::size_t count = 0;
  for (const double pa : run.pressure_pa) {
    if (std::isnan(pa)) continue;
    low = std::min(low, pa), high = std::max(high, pa);
    ++count;
  }
  if (run.pressure_pa.empty()) return;  // reported
  if (count < kReadingsMin) {
    owner.FailAt(field, "must hold at least " + std::to_string(kReadingsMin) + " readings, not " +
                            std::to_string(count));
    return;
  }
  const double high_kpa = KpaGaugeFromPa(high, run.ambient);
  if (low == high)
    owner.FailAt(field, "must change; all " + std::to_string(count) + " readings are " +
                            Decimal(Rounded(high_kpa)));
  // What evacuates can be the cause of as much the other way.
  const double ambient_pa = run.ambient.pressure_pa;
  double cause_pa = ambient_pa + std::max({std::abs(run.source_pressure_pa - ambient_pa),
                                           model::Span(run.chamber),
                                           run.initial_pressure_pa.value_or(0.0) - ambient_pa});
  for (const double pa : run.channels.source_pressure_pa)
    if (!std::isnan(pa)) cause_pa = std::max(cause_pa, pa);
  if (run.supply == Supply::kCompressor)
    cause_pa = std::max(cause_pa, run.compressor.pressure_max_pa);
  if (run.volume_imposed && !run.channels.volume_m3.empty()) cause_pa *= SqueezeOf(run);
  const double cause_kpa = KpaGaugeFromPa(cause_pa, run.ambient);
  if (run.initial_pressure_pa && high_kpa > kAbsurd * cause_kpa)
    owner.FailAt(field, "reaches " + Decimal(Rounded(high_kpa)) +
                            " kPa, but nothing in the run is above " + Decimal(Rounded(cause_kpa)) +
                            " kPa; are the units kPa?");
}

}  // namespace

Run ReadRun(const Element& element, const Json& shared, std::set<std::string>& ids,
            calibration::Dataset& dataset, std::vector<Run>& of_gauges, Errors& errors) {
  Reader reader(element, errors);
  AllowRemarks(reader);
  Run run;
  run.id = reader.Text("id");
  if (!run.id.empty() && !ids.insert(run.id).second)
    reader.Fail("id", "must be unique; " + Quoted(run.id) + " is taken by an earlier run");
  run.specimen = PlaceOf(ReadSpecimen(reader), dataset.specimens);
  const MeasuredRig rig = ReadRigOfRun(shared, reader.Has("rig") ? reader.Raw("rig") : nullptr,
                                       reader.Pointer("rig"), errors);
  run.ambient = rig.ambient;
  run.chamber = rig.chamber;
  run.several = rig.several;
  run.line = rig.line;
  run.gas = rig.gas;
  run.supply = rig.supply;
  run.compressor = rig.compressor;
  run.reservoir_volume_m3 = rig.reservoir_volume_m3;
  run.sensor = rig.sensor;
  TakeMeasured(rig.measured, dataset.measured, run);
  ReadVolume(reader, run);
  const Range pressures = PressuresFrom0(run.ambient);
  const auto source_kpa = reader.OptionalNumber(
      "source_pressure_kpa_gauge",
      run.supply == Supply::kRegulated ? pressures : Range{0, kRigGaugeMaxKpa});
  const bool has_source = source_kpa || rig.source_pressure_pa;
  run.source_pressure_pa = source_kpa ? PaFromKpaGaugeOf(*source_kpa, run.ambient)
                                      : rig.source_pressure_pa.value_or(run.ambient.pressure_pa);
  const auto exhaust_kpa = reader.OptionalNumber("exhaust_pressure_kpa_gauge", pressures);
  run.exhaust_pressure_pa = exhaust_kpa ? PaFromKpaGaugeOf(*exhaust_kpa, run.ambient)
                                        : rig.exhaust_pressure_pa.value_or(0.0);
  ReadInitial(reader, run);
  ReadMeasuredValve(reader, run);
  run.t_s = ReadSeries(reader, "t_s", {-kTimeMaxS, kTimeMaxS}, false, kReadingsMin);
  CheckRising(reader, run.t_s);
  const double lowest_kpa = -run.ambient.pressure_pa / kPaPerKpa;
  run.pressure_pa = InSi(ReadSeries(reader, "pressure_kpa_gauge",
                                    {1.5 * lowest_kpa, HighestKpa(run)}, true, kReadingsMin),
                         [&](double kpa) { return PaFromKpaGauge(kpa, run.ambient); });
  CheckLength(reader, "pressure_kpa_gauge", run.pressure_pa.size(), run.t_s.size());
  FindInstants(reader, run);
  const ChamberReadings chambers = ReadChannels(reader, run);
  CheckDriven(reader, run);
  CheckAgreement(reader, run, has_source || calibration::FollowsSetpoint(run));
  CheckReadings(reader, "pressure_kpa_gauge", run);
  CheckSeveral(reader, run);
  for (Run& other : RunsOfGauges(run, chambers)) {
    CheckReadings(reader, "channels/chambers/" + run.several.all[other.several.gauge].name, other);
    of_gauges.push_back(std::move(other));
  }
  reader.Finish();
  return run;
}

}  // namespace plenum::api
