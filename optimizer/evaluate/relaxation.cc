#include "optimizer/evaluate/relaxation.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace plenum::optimizer {
namespace {

constexpr double kGuideRoom = 1.005;

enum class Kind { kSlows, kLeaks, kOther };

Kind KindOf(const model::Effect& effect) {
  constexpr auto kSlowing =
      std::to_array<std::string_view>({"valve_delay", "valve_ramp", "dead_volume", "supply_droop",
                                       "exhaust_restriction", "cracking_pressure"});
  const std::string_view id = effect.spec->id;
  if (effect.spec->place == model::EffectPlace::kSensor) return Kind::kSlows;  // changes nothing
  if (std::find(kSlowing.begin(), kSlowing.end(), id) != kSlowing.end()) return Kind::kSlows;
  if (id == "directional_conductance" && effect.parameters.front() <= 1.0) return Kind::kSlows;
  return id == "leak" ? Kind::kLeaks : Kind::kOther;
}

bool Any(const ActuatorGroup& group, Kind kind) {
  return std::any_of(group.effects.begin(), group.effects.end(),
                     [&](const model::Effect& effect) { return KindOf(effect) == kind; });
}

// What a delay leaves of a limit; next to nothing where it takes all.
double Less(double limit_s, double delay_s) { return std::max(limit_s - delay_s, 1e-9); }

const Margin* Find(const std::vector<Margin>& margins, const std::string& requirement) {
  const auto found = std::find_if(margins.begin(), margins.end(), [&](const Margin& margin) {
    return margin.requirement == requirement;
  });
  return found == margins.end() ? nullptr : &*found;
}

}  // namespace

Problem WithoutEffects(Problem problem) {
  for (ActuatorGroup& group : problem.groups) group.effects.clear();
  return problem;
}

Problem Guide(const Problem& problem, const Design& nominal, const std::vector<Margin>& revised) {
  Problem guide = WithoutEffects(problem);
  // What the requirement's quantity becomes for one of the base model; 1 where it is not limited.
  const auto ratio = [&](const std::string& requirement) {
    const Margin* before = Find(nominal.margins, requirement);
    const Margin* after = Find(revised, requirement);
    return before && after && before->achieved > 0.0 ? after->achieved / before->achieved : 1.0;
  };
  for (std::size_t g = 0; g < guide.groups.size(); ++g) {
    ActuatorGroup& group = guide.groups[g];
    const std::string pointer = GroupPointer(guide, static_cast<int>(g));
    group.rise_time_max_s *= kGuideRoom / ratio(pointer + "/rise_time_s_max");
    group.fall_time_max_s *= kGuideRoom / ratio(pointer + "/fall_time_s_max");
  }
  guide.actuations /= kGuideRoom * ratio("/duty/actuations");
  return guide;
}

Problem Relaxed(const Problem& problem) {
  Problem relaxed = problem;
  for (ActuatorGroup& group : relaxed.groups) {
    if (Any(group, Kind::kOther)) {
      group.rise_time_max_s *= kRoom;
      group.fall_time_max_s *= kRoom;
      relaxed.actuations = problem.actuations / kRoom;
    }
    if (Any(group, Kind::kLeaks)) group.fall_time_max_s = kUnlimited;
    for (const model::Effect& effect : group.effects) {
      if (effect.spec->id == "dead_volume")
        group.chamber.dead_volume_m3 += effect.parameters.front();
      if (effect.spec->id == "valve_delay") {
        group.rise_time_max_s = Less(group.rise_time_max_s, effect.parameters.front());
        group.fall_time_max_s = Less(group.fall_time_max_s, effect.parameters.front());
      }
    }
  }
  return WithoutEffects(std::move(relaxed));
}

bool RelaxationIsProved(const Problem& problem) {
  return std::none_of(problem.groups.begin(), problem.groups.end(),
                      [](const ActuatorGroup& group) { return Any(group, Kind::kOther); });
}

}  // namespace plenum::optimizer
