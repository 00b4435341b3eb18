#include "verify/design/verify_kinds.h"

#include <map>

namespace plenum::verify {
namespace {

enum class Place { kNowhere, kSource, kRegulator, kValve };

Place PlaceOf(Family family) {
  switch (family) {
    case Family::kCompressor:
    case Family::kVacuumPump:
    case Family::kEjector:
    case Family::kCylinder:
    case Family::kCo2:
    case Family::kTank:
      return Place::kSource;
    case Family::kRegulator:
      return Place::kRegulator;
    case Family::kValve:
      return Place::kValve;
    default:
      return Place::kNowhere;
  }
}

}  // namespace

bool ListsKinds(const Problem& problem) { return problem.list == optimizer::ListOf::kKinds; }

std::string SeriesName(const Problem& problem, Family family, int part) {
  if (part < 0 || PlaceOf(family) == Place::kNowhere) return {};
  const auto& basics = BasicsOf(problem.parts, family, part);
  return basics.series.empty() ? "part " + basics.id : "series " + basics.series;
}

void AddSeries(Family family, const std::string& series, KindName& kind) {
  if (series.empty()) return;  // a choice of no part
  const Place place = PlaceOf(family);
  if (place == Place::kSource) kind.source.second.insert(series);
  if (place == Place::kRegulator) kind.regulators.insert(series);
  if (place == Place::kValve) kind.valves.insert(series);
}

KindName KindOf(const Problem& problem, const Design& design) {
  KindName kind;
  kind.source.first = design.configuration;
  for (const Choice& choice : design.parts)
    AddSeries(choice.family,
              SeriesName(problem, choice.family, FindPart(problem.parts, choice.family, choice.id)),
              kind);
  return kind;
}

// Other sources make other sources; other regulators and other valves, unless some other group has
// them, make other kinds of the same source.
bool AreEnough(const Problem& problem, const ProofSlot& slot, std::size_t others) {
  const auto count = static_cast<std::size_t>(problem.count);
  const std::size_t of_source =
      std::min(count, static_cast<std::size_t>(problem.limits.per_source));
  switch (PlaceOf(slot.family)) {
    case Place::kSource:
      return others >= count;
    case Place::kRegulator:
      if (slot.group < 0) return others >= of_source;
      [[fallthrough]];
    case Place::kValve:
      return others + 1 >= of_source + problem.groups.size();
    case Place::kNowhere:
      return others >= 1;
  }
  return false;
}

void CheckKinds(const Problem& problem, const std::vector<Design>& designs, Findings& findings) {
  std::set<KindName> kinds;
  std::map<SourceName, int> of_source;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const std::string rank = "rank " + std::to_string(i + 1);
    const KindName kind = KindOf(problem, designs[i]);
    if (!kinds.insert(kind).second)
      findings.push_back({"order", rank + " is of a kind that is listed already"});
    if (++of_source[kind.source] > problem.limits.per_source)
      findings.push_back({"order", rank + " is one kind too many with the same source"});
  }
}

}  // namespace plenum::verify
