#include "fmu/unit_text.h"

#include <charconv>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

namespace plenum::fmu {
namespace {

constexpr std::string_view kVersion = "plenum-unit/1";
constexpr std::size_t kListMax = 100'000;

// Words between blanks; a text is its length and its bytes.
class Writer {
 public:
  std::string text;

  void operator()(const double& value) { Word(value); }
  void operator()(const int& value) { Word(value); }
  void operator()(const std::size_t& value) { Word(value); }
  void operator()(const bool& value) { Word(value ? 1 : 0); }
  void operator()(const std::string& value) {
    Word(value.size());
    text += value + " ";
  }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void operator()(const Enum& value, int /*count*/) { Word(static_cast<int>(value)); }

 private:
  template <typename Number>
  void Word(Number value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    text.append(digits, end) += ' ';
  }
};

// Gives zeros once something could not be read.
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  bool failed = false;

  void operator()(double& value) { Word(value); }
  void operator()(int& value) { Word(value); }
  void operator()(std::size_t& value) { Word(value); }
  void operator()(bool& value) {
    int number = 0;
    Word(number);
    value = number != 0;
  }
  void operator()(std::string& value) {
    std::size_t size = 0;
    Word(size);
    failed = failed || size + 1 > rest_.size();
    if (failed) return;
    value = rest_.substr(0, size);
    rest_.remove_prefix(size + 1);
  }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void operator()(Enum& value, int count) {
    int number = 0;
    Word(number);
    failed = failed || number < 0 || number >= count;
    if (!failed) value = static_cast<Enum>(number);
  }
  bool at_end() const { return rest_.empty(); }

 private:
  template <typename Number>
  void Word(Number& value) {
    value = Number();
    if (failed) return;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    const auto size = static_cast<std::size_t>(end - rest_.data());
    failed = error != std::errc() || size >= rest_.size() || rest_[size] != ' ';
    if (!failed) rest_.remove_prefix(size + 1);
  }

  std::string_view rest_;
};

// Each field once, for writing (a const value) and for reading.
template <typename Archive, typename Value>
void Pass(Archive& archive, Value& value);

template <typename Archive, typename List>
void PassList(Archive& archive, List& list) {
  std::size_t size = list.size();
  archive(size);
  if constexpr (!std::is_const_v<List>) {
    archive.failed = archive.failed || size > kListMax;
    list.resize(archive.failed ? 0 : size);
  }
  for (auto& entry : list) Pass(archive, entry);
}

template <typename Archive>
void PassCurve(Archive& archive, const model::MonotoneCurve& curve) {
  const std::vector<double> x(curve.x().begin(), curve.x().end());
  const std::vector<double> y(curve.y().begin(), curve.y().end());
  PassList(archive, x);
  PassList(archive, y);
}
void PassCurve(Reader& archive, model::MonotoneCurve& curve) {
  std::vector<double> x, y;
  PassList(archive, x);
  PassList(archive, y);
  archive.failed = archive.failed || x.size() != y.size();
  if (!archive.failed && !x.empty()) curve = model::MonotoneCurve(std::move(x), std::move(y));
}

template <typename Archive, typename Element>
void PassElement(Archive& archive, Element& element) {
  archive(element.sonic_conductance_m3_per_s_pa);
  archive(element.critical_ratio);
  archive(element.subsonic_index);
  archive(element.cracking_pressure_pa);
}

template <typename Archive, typename Chamber>
void PassChamber(Archive& archive, Chamber& chamber) {
  archive(chamber.rest_volume_m3);
  archive(chamber.expansion_ratio);
  archive(chamber.operating_pressure_pa);
  archive(chamber.ambient_pressure_pa);
  archive(chamber.dead_volume_m3);
  PassCurve(archive, chamber.volume_curve);
  archive(chamber.evacuated);
}

template <typename Archive, typename Group>
void PassGroup(Archive& archive, Group& group) {
  archive(group.name);
  PassChamber(archive, group.chamber);
  PassList(archive, group.fill);
  PassList(archive, group.exhaust);
  archive(group.initial_pressure_pa);
}

template <typename Archive, typename Pumps>
void PassPumps(Archive& archive, Pumps& pumps) {
  PassCurve(archive, pumps.compressor.free_air_m3_per_s);
  PassCurve(archive, pumps.compressor.current_a);
  archive(pumps.compressor.voltage_v);
  archive(pumps.compressor.pressure_max_pa);
  archive(pumps.compressor_count);
  archive(pumps.duty);
}

template <typename Archive, typename Regulated>
void PassRegulated(Archive& archive, Regulated& source) {
  archive(source.pressure_pa);
  bool has_regulator = source.regulator.has_value();
  archive(has_regulator);
  if constexpr (!std::is_const_v<Regulated>)
    if (has_regulator) source.regulator.emplace();
  if (source.regulator) PassElement(archive, *source.regulator);
  bool limited = source.flow_max_m3_per_s < std::numeric_limits<double>::infinity();
  archive(limited);
  if (limited) archive(source.flow_max_m3_per_s);
}

template <typename Archive, typename Reservoir>
void PassReservoir(Archive& archive, Reservoir& source) {
  archive(source.volume_m3);
  archive(source.initial_pressure_pa);
  PassPumps(archive, source);
  bool stops = source.stop_pressure_pa < std::numeric_limits<double>::infinity();
  archive(stops);
  if (stops) archive(source.stop_pressure_pa);
}

// Which of its kinds a source is, by its place in the variant.
template <typename Archive, typename Source>
void PassSource(Archive& archive, Source& source) {
  std::size_t kind = source.index();
  archive(kind);
  if constexpr (!std::is_const_v<Source>) {
    if (kind == 1) source = model::RegulatedSource();
    if (kind == 2) source = model::ReservoirSource();
    if (kind == 4) source = model::PumpSource();
    archive.failed = archive.failed || source.index() != kind;
  }
  if (auto* regulated = std::get_if<model::RegulatedSource>(&source))
    PassRegulated(archive, *regulated);
  if (auto* reservoir = std::get_if<model::ReservoirSource>(&source))
    PassReservoir(archive, *reservoir);
  if (auto* pumps = std::get_if<model::PumpSource>(&source)) PassPumps(archive, *pumps);
}

template <typename Archive, typename Value>
void Pass(Archive& archive, Value& value) {
  using Bare = std::remove_const_t<Value>;
  if constexpr (std::is_same_v<Bare, model::FlowElement>)
    PassElement(archive, value);
  else if constexpr (std::is_same_v<Bare, model::GroupRig>)
    PassGroup(archive, value);
  else if constexpr (std::is_same_v<Bare, DrivenValve>)
    archive(value.coil_power_w), archive(value.holds);
  else
    archive(value);
}

template <typename Archive, typename Limit>
void PassLimit(Archive& archive, Limit& value) {
  bool limited = value < std::numeric_limits<double>::infinity();
  archive(limited);
  if (limited) archive(value);
}

template <typename Archive, typename OneUnit>
void PassUnit(Archive& archive, OneUnit& unit) {
  archive(unit.name);
  archive(unit.rig.ambient.pressure_pa);
  archive(unit.rig.ambient.temperature_k);
  archive(unit.rig.gas, 2);
  PassSource(archive, unit.rig.source);
  PassList(archive, unit.rig.groups);
  PassList(archive, unit.valves);
  archive(unit.regulator_power_w);
  PassLimit(archive, unit.energy_available_j);
  PassLimit(archive, unit.air_available_m3);
}

}  // namespace

std::string WriteUnit(const Unit& unit) {
  Writer writer;
  writer(std::string(kVersion));
  PassUnit(writer, unit);
  return std::move(writer.text);
}

std::optional<Unit> ReadUnit(std::string_view text) {
  Reader reader(text);
  std::string version;
  reader(version);
  if (reader.failed || version != kVersion) return std::nullopt;
  Unit unit;
  PassUnit(reader, unit);
  if (reader.failed || !reader.at_end() || unit.valves.size() != unit.rig.groups.size())
    return std::nullopt;
  return unit;
}

std::string GuidOf(std::string_view text) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  char digits[17] = {};
  std::to_chars(digits, digits + 16, hash, 16);
  return "{plenum-" + std::string(digits) + "}";
}

}  // namespace plenum::fmu
