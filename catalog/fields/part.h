// A row of the catalogue, as stored: numbers in the units of data sheets and of the contract, each
// with where it comes from. Conversion to SI happens in api/.
#ifndef PLENUM_CATALOG_FIELDS_PART_H_
#define PLENUM_CATALOG_FIELDS_PART_H_

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

// datasheet: in a vendor's document; third_party: found elsewhere or in a damaged copy; derived:
// converted or computed from such numbers; estimated: assumed by a stated rule; measured: fitted to
// the user's own measurement of the part.
enum class Provenance { kDatasheet, kThirdParty, kDerived, kEstimated, kMeasured };
std::string_view Name(Provenance provenance);
std::optional<Provenance> ProvenanceFromName(std::string_view name);
// All of them, in the order above.
std::span<const std::string_view> ProvenanceNames();

struct Number {
  double value = 0.0;
  Provenance provenance = Provenance::kThirdParty;
  std::string source;
  std::optional<double> uncertainty =
      std::nullopt;  // relative, one standard deviation; none: not known
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
  // Of the whole curve, as that of a number.
  std::optional<double> free_air_uncertainty = std::nullopt;
  std::optional<double> current_uncertainty = std::nullopt;
  bool operator==(const Curve&) const = default;
};

// What a supplier asks, net of tax. For parts that are sold by length a piece is a metre.
struct Offer {
  std::string supplier;
  double price = 0.0;    // of a pack
  std::string currency;  // ISO 4217, one that catalog/fields/price.h can convert
  double pack = 1.0;     // pieces in a pack
  std::string date;      // "2024", "2024-05", "2024-05-31"; empty: not known
  std::string link;      // may be empty
  bool operator==(const Offer&) const = default;
};

struct Document {
  std::string link;    // address, or where the document is found; may be empty with a digest
  std::string sha256;  // 64 hexadecimal digits, or empty
  bool operator==(const Document&) const = default;
};

struct Part {
  std::string id;
  std::string family;
  std::string manufacturer;
  std::string part_number;
  std::string origin = "user";  // "seed" or "user"
  std::string notes;
  std::string series;                // maker and model base that variants share; empty: its own
  std::optional<bool> orderable;     // whether it is a product that one can order; none: not known
  std::vector<std::string> aliases;  // other names and numbers of the same part
  std::vector<Offer> offers;
  std::vector<Document> documents;
  std::map<std::string, Number> numbers;  // by field name
  std::map<std::string, Text> texts;
  std::optional<Curve> curve;
  bool operator==(const Part&) const = default;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_PART_H_
