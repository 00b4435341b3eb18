#include "model/effects/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include "model/effects/cracking_pressure.h"
#include "model/effects/creep.h"
#include "model/effects/dead_volume.h"
#include "model/effects/directional_conductance.h"
#include "model/effects/exhaust_restriction.h"
#include "model/effects/heat_transfer.h"
#include "model/effects/hysteresis.h"
#include "model/effects/inertia.h"
#include "model/effects/leak.h"
#include "model/effects/learned/learned_conductance.h"
#include "model/effects/learned/learned_leak.h"
#include "model/effects/learned/learned_sensor.h"
#include "model/effects/learned/learned_supply.h"
#include "model/effects/learned/learned_valve.h"
#include "model/effects/learned/learned_volume.h"
#include "model/effects/line_dynamics.h"
#include "model/effects/nonlinear_compliance.h"
#include "model/effects/outgassing.h"
#include "model/effects/sensor_gain.h"
#include "model/effects/sensor_lag.h"
#include "model/effects/sensor_offset.h"
#include "model/effects/supply_droop.h"
#include "model/effects/valve_delay.h"
#include "model/effects/valve_ramp.h"
#include "model/effects/wall_heat.h"

namespace plenum::model {
namespace {

template <class T>
using Maker = std::unique_ptr<EffectUnit<T>> (*)(std::span<const T>);

struct Entry {
  const EffectSpec* spec;
  Maker<double> make;
  Maker<Dual> make_dual;
  Maker<WideDual> make_wide;
};

template <template <class> class Unit, class T>
std::unique_ptr<EffectUnit<T>> Make(std::span<const T> parameters) {
  return std::make_unique<Unit<T>>(parameters);
}

template <template <class> class Unit>
constexpr Entry MakeEntry() {
  return {&Unit<double>::kSpec, Make<Unit, double>, Make<Unit, Dual>, Make<Unit, WideDual>};
}

// The units of one number of knots.
template <int N>
struct Learned {
  template <class T>
  using Leak = LearnedLeak<T, N>;
  template <class T>
  using ConductanceByPressure = LearnedConductance<T, N, ConductanceFeature::kPressure>;
  template <class T>
  using ConductanceByExpansion = LearnedConductance<T, N, ConductanceFeature::kExpansion>;
  template <class T>
  using Volume = LearnedVolume<T, N>;
  template <class T>
  using Memory = LearnedMemory<T, N>;
  template <class T>
  using Sensor = LearnedSensor<T, N>;
};

// In the order of application: what comes later acts on what those before it have left.
constexpr auto kRegistry = std::to_array<Entry>({
    MakeEntry<ValveDelay>(),
    MakeEntry<ValveRamp>(),
    MakeEntry<LearnedLateStrokes>(),
    MakeEntry<LearnedSwingOfSupply>(),
    MakeEntry<DirectionalConductance>(),
    MakeEntry<CrackingPressure>(),
    MakeEntry<ExhaustRestriction>(),
    MakeEntry<DeadVolume>(),
    MakeEntry<NonlinearCompliance>(),
    MakeEntry<Hysteresis>(),
    MakeEntry<Learned<3>::Volume>(),
    MakeEntry<Learned<5>::Volume>(),
    MakeEntry<Learned<9>::Volume>(),
    MakeEntry<LearnedBend>(),
    MakeEntry<Learned<1>::Memory>(),
    MakeEntry<Learned<3>::Memory>(),
    MakeEntry<Creep>(),
    MakeEntry<Inertia>(),
    MakeEntry<HeatTransfer>(),
    MakeEntry<WallHeat>(),
    MakeEntry<SupplyDroop>(),
    MakeEntry<LineDynamics>(),
    MakeEntry<Learned<3>::ConductanceByPressure>(),
    MakeEntry<Learned<5>::ConductanceByPressure>(),
    MakeEntry<Learned<9>::ConductanceByPressure>(),
    MakeEntry<Learned<3>::ConductanceByExpansion>(),
    MakeEntry<Learned<5>::ConductanceByExpansion>(),
    MakeEntry<Learned<9>::ConductanceByExpansion>(),
    MakeEntry<LeakOrifice>(),
    MakeEntry<LeakLaminar>(),
    MakeEntry<LeakPorous>(),
    MakeEntry<Outgassing>(),
    MakeEntry<Learned<3>::Leak>(),
    MakeEntry<Learned<5>::Leak>(),
    MakeEntry<Learned<9>::Leak>(),
    MakeEntry<LearnedOpening>(),
    MakeEntry<LearnedStore>(),
    MakeEntry<SensorLag>(),
    MakeEntry<SensorGain>(),
    MakeEntry<SensorOffset>(),
    MakeEntry<Learned<3>::Sensor>(),
    MakeEntry<Learned<5>::Sensor>(),
    MakeEntry<Learned<9>::Sensor>(),
    MakeEntry<LearnedDrift>(),
    MakeEntry<LearnedSwingOfSensor>(),
});

constexpr auto kSpecs = [] {
  std::array<const EffectSpec*, kRegistry.size()> specs{};
  for (std::size_t i = 0; i < specs.size(); ++i) specs[i] = kRegistry[i].spec;
  return specs;
}();

// What stands for the same part of the rig.
constexpr std::pair<std::string_view, std::string_view> kInstead[] = {
    {"heat_transfer", "wall_heat"}};

bool Exclude(std::string_view a, std::string_view b) {
  return std::any_of(std::begin(kInstead), std::end(kInstead), [&](const auto& pair) {
    return pair == std::pair(a, b) || pair == std::pair(b, a);
  });
}

std::string Title(const EffectSpec& spec) {
  std::string title(spec.id);
  if (!spec.law.empty()) title += " (" + std::string(spec.law) + ")";
  return title;
}

}  // namespace

std::span<const EffectSpec* const> Effects() { return kSpecs; }

const EffectSpec* FindEffect(std::string_view id, std::string_view law) {
  const auto found = std::find_if(kSpecs.begin(), kSpecs.end(), [&](const EffectSpec* spec) {
    return spec->id == id && (law.empty() || spec->law == law);
  });
  return found == kSpecs.end() ? nullptr : *found;
}

std::string WhyInvalid(std::span<const Effect> effects) {
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const Effect& effect = effects[i];
    const std::string field = "effects[" + std::to_string(i) + "]";
    if (std::find(kSpecs.begin(), kSpecs.end(), effect.spec) == kSpecs.end()) {
      return field + " has no spec of a known effect";
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (effects[j].spec->id == effect.spec->id) {
        return field + ": " + Title(*effect.spec) + " stands there twice";
      }
      if (Exclude(effects[j].spec->id, effect.spec->id)) {
        return field + ": " + Title(*effect.spec) + " cannot stand beside " +
               Title(*effects[j].spec);
      }
    }
    const auto specs = effect.spec->parameters;
    if (effect.parameters.size() != specs.size()) {
      return field + ": " + Title(*effect.spec) + " takes " + std::to_string(specs.size()) +
             " parameters, not " + std::to_string(effect.parameters.size());
    }
    for (std::size_t j = 0; j < specs.size(); ++j) {
      const double value = effect.parameters[j];
      if (value >= specs[j].low && value <= specs[j].high) continue;
      std::ostringstream text;
      text.precision(17);
      text << field << ": " << Title(*effect.spec) << "." << specs[j].name << " is " << value
           << ", must be in [" << specs[j].low << ", " << specs[j].high << "]";
      return text.str();
    }
  }
  return {};
}

template <class T>
std::vector<std::unique_ptr<EffectUnit<T>>> MakeUnits(std::span<const Effect> effects,
                                                      const Lift& lift) {
  std::vector<std::unique_ptr<EffectUnit<T>>> units;
  for (const Entry& entry : kRegistry) {
    for (const Effect& effect : effects) {
      if (effect.spec != entry.spec) continue;
      std::vector<T> parameters;
      for (const double& number : effect.parameters)
        parameters.push_back(lift.operator()<T>(number));
      if constexpr (std::is_same_v<T, WideDual>) {
        units.push_back(entry.make_wide(parameters));
      } else if constexpr (kIsDual<T>) {
        units.push_back(entry.make_dual(parameters));
      } else {
        units.push_back(entry.make(parameters));
      }
    }
  }
  return units;
}

template std::vector<std::unique_ptr<EffectUnit<double>>> MakeUnits(std::span<const Effect>,
                                                                    const Lift&);
template std::vector<std::unique_ptr<EffectUnit<Dual>>> MakeUnits(std::span<const Effect>,
                                                                  const Lift&);
template std::vector<std::unique_ptr<EffectUnit<WideDual>>> MakeUnits(std::span<const Effect>,
                                                                      const Lift&);

}  // namespace plenum::model
