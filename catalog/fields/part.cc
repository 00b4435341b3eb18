#include "catalog/fields/part.h"

#include <array>

namespace plenum::catalog {
namespace {

// In the order of Provenance.
constexpr std::array<std::string_view, 5> kNames{"datasheet", "third_party", "derived", "estimated",
                                                 "measured"};

}  // namespace

std::string_view Name(Provenance provenance) {
  return kNames.at(static_cast<std::size_t>(provenance));
}

std::optional<Provenance> ProvenanceFromName(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<Provenance>(i);
  return std::nullopt;
}

std::span<const std::string_view> ProvenanceNames() { return kNames; }

}  // namespace plenum::catalog
