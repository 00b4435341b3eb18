#include "api/design/read/objective_reader.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "api/json/words.h"

namespace plenum::api {
namespace {

struct NamedWeight {
  const char* name;
  double optimizer::Objective::*weight;
};
constexpr NamedWeight kWeights[] = {{"mass_kg", &optimizer::Objective::mass_kg},
                                    {"volume_l", &optimizer::Objective::volume_l},
                                    {"cost_eur", &optimizer::Objective::cost_eur},
                                    {"energy_wh", &optimizer::Objective::energy_wh}};

// The amounts of a front; without "minimize" its designs are listed by the first of them.
void ReadPareto(Reader& reader, std::vector<optimizer::Amount>& pareto) {
  constexpr optimizer::Amount kAmounts[] = {optimizer::Amount::kMass, optimizer::Amount::kVolume,
                                            optimizer::Amount::kCost, optimizer::Amount::kEnergy};
  std::vector<std::string> names;
  for (const optimizer::Amount amount : kAmounts) names.emplace_back(optimizer::Name(amount));
  const std::vector<std::string> given = reader.Texts("pareto", 2, 3);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), given[i]);
    if (found != names.end())
      pareto.push_back(kAmounts[found - names.begin()]);
    else if (!given[i].empty())
      reader.FailAt("pareto/" + std::to_string(i),
                    "must be " + OneOf(names) + ", not " + Quoted(given[i]));
  }
}

optimizer::Objective ReadMinimize(Reader& reader) {
  optimizer::Objective objective;
  const Json* minimize = reader.Raw("minimize");
  if (minimize != nullptr && minimize->is_object()) {
    Reader weights = reader.Object("minimize");
    double sum = 0.0;
    for (const auto& [name, weight] : kWeights)
      sum += objective.*weight = weights.Number(name, {0, 1e6}, 0.0);
    weights.Finish();
    if (sum == 0.0) weights.FailHere("at least one weight must be > 0");
    return objective;
  }
  std::vector<std::string> names;
  for (const NamedWeight& weight : kWeights) names.emplace_back(weight.name);
  const std::string chosen = reader.Choice("minimize", names);
  for (const auto& [name, weight] : kWeights) objective.*weight = chosen == name ? 1.0 : 0.0;
  return objective;
}

}  // namespace

void ReadObjective(Reader& request, optimizer::Objective& objective,
                   std::vector<optimizer::Amount>& pareto) {
  auto reader = request.OptionalObject("objective");
  if (!reader) {
    objective.mass_kg = 1.0;
    return;
  }
  if (reader->Has("pareto")) ReadPareto(*reader, pareto);
  if (reader->Has("minimize") || !reader->Has("pareto"))
    objective = ReadMinimize(*reader);
  else if (!pareto.empty())
    for (const auto& [name, weight] : kWeights)
      if (std::string_view(name) == optimizer::Name(pareto.front())) objective.*weight = 1.0;
  if (!pareto.empty())
    for (const auto& [name, weight] : kWeights)
      if (objective.*weight > 0.0 &&
          std::none_of(pareto.begin(), pareto.end(),
                       [wanted = std::string_view(name)](optimizer::Amount amount) {
                         return wanted == optimizer::Name(amount);
                       }))
        reader->Fail("minimize",
                     std::string(name) +
                         " is not an amount of the front; it orders the front's designs "
                         "and must be made of these");
  reader->Finish();
}

}  // namespace plenum::api
