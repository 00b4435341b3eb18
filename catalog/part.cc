#include "catalog/part.h"

#include <array>

namespace plenum::catalog {
namespace {

struct Naming {
  Provenance provenance;
  std::string_view name;
};

constexpr std::array<Naming, 4> kNames{{{Provenance::kDatasheet, "datasheet"},
                                        {Provenance::kThirdParty, "third_party"},
                                        {Provenance::kDerived, "derived"},
                                        {Provenance::kEstimated, "estimated"}}};

}  // namespace

std::string_view Name(Provenance provenance) {
  for (const Naming& naming : kNames)
    if (naming.provenance == provenance) return naming.name;
  return {};
}

std::optional<Provenance> ProvenanceFromName(std::string_view name) {
  for (const Naming& naming : kNames)
    if (naming.name == name) return naming.provenance;
  return std::nullopt;
}

}  // namespace plenum::catalog
