// A row of the catalogue, as stored: numbers in the units of data sheets and of the contract, each
// with where it comes from. Conversion to SI happens in api/.
#ifndef PLENUM_CATALOG_PART_H_
#define PLENUM_CATALOG_PART_H_

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

// datasheet: in a vendor's document; third_party: found elsewhere or in a damaged copy; derived:
// converted or computed from such numbers; estimated: assumed by a stated rule.
enum class Provenance { kDatasheet, kThirdParty, kDerived, kEstimated };
std::string_view Name(Provenance provenance);
std::optional<Provenance> ProvenanceFromName(std::string_view name);

struct Number {
  double value = 0.0;
  Provenance provenance = Provenance::kThirdParty;
  std::string source;
  bool operator==(const Number&) const = default;
};

struct Text {
  std::string value;
  Provenance provenance = Provenance::kThirdParty;
  std::string source;
  bool operator==(const Text&) const = default;
};

// Compressors only. `free_air` and `current` of all points share one provenance each.
struct CurvePoint {
  double pressure_kpa_gauge = 0.0;
  double free_air_l_per_min = 0.0;
  double current_a = 0.0;
  bool operator==(const CurvePoint&) const = default;
};

struct Curve {
  std::vector<CurvePoint> points;  // pressure strictly rising, flow not rising
  Provenance free_air_provenance = Provenance::kThirdParty;
  std::string free_air_source;
  Provenance current_provenance = Provenance::kThirdParty;
  std::string current_source;
  bool operator==(const Curve&) const = default;
};

struct Part {
  std::string id;
  std::string family;
  std::string manufacturer;
  std::string part_number;
  std::string origin = "user";  // "seed" or "user"
  std::string notes;
  std::map<std::string, Number> numbers;  // by field name
  std::map<std::string, Text> texts;
  std::optional<Curve> curve;
  bool operator==(const Part&) const = default;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_PART_H_
