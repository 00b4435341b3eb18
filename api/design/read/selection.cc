#include "api/design/read/selection.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "api/json/request_limits.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

using optimizer::Configuration;
using optimizer::Family;

constexpr std::array kFamilies{Family::kTubing,     Family::kFitting,   Family::kValve,
                               Family::kCompressor, Family::kCylinder,  Family::kCo2,
                               Family::kBattery,    Family::kRegulator, Family::kReservoir};

// Whether the request leaves a part of the family to choose.
bool HasChoice(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
               Family family) {
  if (family == Family::kReservoir && IsAllowed(problem, family, kCustomReservoir)) return true;
  return std::any_of(parts.begin(), parts.end(), [&](const catalog::Part& part) {
    return part.family == optimizer::Name(family) && IsAllowed(problem, family, part.id);
  });
}

// Where to look for the reason why a family is empty.
std::string PointerFor(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
                       Family family) {
  const std::string name = optimizer::Name(family);
  if (problem.require.contains(family)) return "/require/" + name;
  const bool in_catalogue = std::any_of(
      parts.begin(), parts.end(), [&](const catalog::Part& part) { return part.family == name; });
  return in_catalogue || family == Family::kReservoir ? "/exclude" : "";
}

}  // namespace

std::vector<Family> SourceFamilies(Configuration configuration) {
  switch (configuration) {
    case Configuration::kCylinder:
      return {Family::kCylinder, Family::kRegulator, Family::kBattery};
    case Configuration::kCo2:
      return {Family::kCo2, Family::kRegulator, Family::kBattery};
    case Configuration::kCompressor:
      return {Family::kCompressor, Family::kReservoir, Family::kBattery};
    case Configuration::kMains:
      return {Family::kRegulator};
  }
  return {};
}

bool IsAllowed(const optimizer::Problem& problem, Family family, const std::string& id) {
  const auto required = problem.require.find(family);
  return !problem.exclude.contains(id) &&
         (required == problem.require.end() || required->second.contains(id));
}

void ReadSelection(Reader& request, const std::vector<catalog::Part>& parts,
                   optimizer::Problem& problem) {
  std::map<std::string, std::string> family_of;
  std::vector<std::string> ids;
  for (const catalog::Part& part : parts) {
    family_of[part.id] = part.family;
    ids.push_back(part.id);
  }
  const auto unknown = [&](const std::string& id) {
    const std::string nearest = Nearest(id, ids);
    return "no part " + Quoted(id) + " in the catalogue" +
           (nearest.empty() ? "" : "; nearest id: " + nearest);
  };

  if (auto require = request.OptionalObject("require")) {
    for (const Family family : kFamilies) {
      const std::string name = optimizer::Name(family);
      if (!require->Has(name)) continue;
      const std::vector<std::string> wanted = require->Texts(name, 1, kExcludedMax);
      for (std::size_t i = 0; i < wanted.size() && !require->Full(); ++i) {
        const std::string& id = wanted[i];
        const std::string place = name + "/" + std::to_string(i);
        if (id.empty() || (family == Family::kReservoir && id == kCustomReservoir)) continue;
        const auto found = family_of.find(id);
        if (found == family_of.end())
          require->FailAt(place, unknown(id));
        else if (found->second != name)
          require->FailAt(place, Quoted(id) + " is a " + found->second + ", not a " + name);
      }
      problem.require[family] = {wanted.begin(), wanted.end()};
    }
    require->Finish();
  }

  if (!request.Has("exclude")) return;
  const std::vector<std::string> unwanted = request.Texts("exclude", 0, kExcludedMax);
  for (std::size_t i = 0; i < unwanted.size() && !request.Full(); ++i)
    if (const std::string& id = unwanted[i];
        !id.empty() && id != kCustomReservoir && !family_of.contains(id))
      request.FailAt("exclude/" + std::to_string(i), unknown(id));
  problem.exclude = {unwanted.begin(), unwanted.end()};
}

std::vector<catalog::Part> AllowedParts(const std::vector<catalog::Part>& parts,
                                        const optimizer::Problem& problem) {
  std::vector<catalog::Part> allowed;
  for (const Family family : kFamilies)
    for (const catalog::Part& part : parts)
      if (part.family == optimizer::Name(family) && IsAllowed(problem, family, part.id))
        allowed.push_back(part);
  return allowed;
}

void CheckFamilies(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
                   bool needs_fittings, Errors& errors) {
  std::vector<Family> shared{Family::kTubing, Family::kValve};
  if (needs_fittings) shared.push_back(Family::kFitting);
  std::vector<Family> empty;
  for (const Configuration configuration : problem.configurations) {
    bool possible = true;
    std::vector<Family> needed = SourceFamilies(configuration);
    needed.insert(needed.begin(), shared.begin(), shared.end());
    for (const Family family : needed) {
      if (HasChoice(parts, problem, family)) continue;
      possible = false;
      if (std::find(empty.begin(), empty.end(), family) == empty.end()) empty.push_back(family);
    }
    if (possible) return;
  }
  for (const Family family : empty)
    errors.push_back({PointerFor(parts, problem, family),
                      std::string("no part of the family ") + optimizer::Name(family) +
                          " is left to choose; every allowed configuration lacks a family that "
                          "it needs"});
}

}  // namespace plenum::api
