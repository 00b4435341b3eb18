// Effects in words: every effect has a sentence, and its figures are those of the simulator.
#include "api/measure/words/effect_words.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "model/simulate/simulate.h"

namespace plenum::api {
namespace effect_words_test {

Scale RigidLitre(double highest_pa) {
  Scale scale;
  scale.chamber.rest_volume_m3 = 1e-3;
  scale.chamber.operating_pressure_pa = highest_pa;
  scale.chamber.ambient_pressure_pa = scale.ambient.pressure_pa;
  scale.highest_pa = highest_pa;
  return scale;
}

model::Effect Made(const char* id, const char* law, std::vector<double> values) {
  return {model::FindEffect(id, law), std::move(values)};
}

// What a rigid litre loses in a short time while its valve holds, L/min ANR.
double SimulatedLeak(const model::Effect& leak, double pressure_pa) {
  model::Rig rig;
  const Scale scale = RigidLitre(pressure_pa);
  rig.ambient = scale.ambient;
  model::GroupRig group;
  group.chamber = scale.chamber;
  group.initial_pressure_pa = pressure_pa;
  group.fill = group.exhaust = {{1e-9, 0.3}};
  group.effects = {leak};
  rig.groups = {group};
  model::SimulateOptions options;
  options.end_s = 1e-2;
  const model::Response response = model::Simulate(rig, options);
  EXPECT_EQ(response.status, model::SimulateStatus::kDone);
  const double lost = pressure_pa - response.groups.at(0).final_pressure_pa;
  return 6e4 * lost * 1e-3 / model::kReferencePressurePa * model::kReferenceTemperatureK /
         scale.ambient.temperature_k / options.end_s;
}

TEST(EffectWords, ALeakIsTheSimulatorsInLitresAndFills) {
  const double pressure_pa = 8e5;
  for (const model::Effect& leak :
       {Made("leak", "orifice", {2e-11, 0.2}), Made("leak", "laminar", {3e-12}),
        Made("leak", "porous", {5e15, 0.0}), Made("leak", "porous", {5e15, 1e20})}) {
    const std::string words = EffectInWords(leak, RigidLitre(pressure_pa));
    double l_per_min = 0.0, percent = 0.0;
    ASSERT_EQ(
        std::sscanf(words.c_str(), "it leaks %lf L/min at 700 kPa gauge, %lf %% of a fill each",
                    &l_per_min, &percent),
        2)
        << words;
    const double simulated = SimulatedLeak(leak, pressure_pa);
    EXPECT_NEAR(l_per_min, simulated, 0.01 * simulated) << words;
    // A fill of a rigid litre to 700 kPa gauge is 7 L.
    const double per_minute = 100.0 * simulated / 7.0;
    const bool each_second = words.ends_with("second");
    EXPECT_NEAR(percent, each_second ? per_minute / 60.0 : per_minute, 0.06 * percent) << words;
  }
}

TEST(EffectWords, EveryEffectHasASentenceWithItsFigures) {
  for (const model::EffectSpec* spec : model::Effects()) {
    model::Effect effect{spec, {}};
    for (const model::ParameterSpec& parameter : spec->parameters)
      effect.parameters.push_back(std::max(parameter.low, std::min(0.5, parameter.high)));
    const std::string words = EffectInWords(effect, RigidLitre(3e5));
    EXPECT_EQ(words.empty(), spec->id.starts_with("learned")) << spec->id;
    EXPECT_EQ(words.find("nan"), std::string::npos) << words;
    EXPECT_EQ(words.find('_'), std::string::npos) << words;
  }
  const Scale scale = RigidLitre(3e5);
  EXPECT_EQ(EffectInWords(Made("dead_volume", "", {9e-5}), scale),
            "it has 90 mL that were not declared, 9 % of the volume at rest");
  EXPECT_EQ(EffectInWords(Made("creep", "", {0.15, 2.0}), scale),
            "its wall creeps: it expands by 15 % more than at once, with a time constant of 2 s");
  EXPECT_EQ(EffectInWords(Made("valve_delay", "", {0.02}), scale), "the valve acts 20 ms late");
  EXPECT_EQ(EffectInWords(Made("sensor_gain", "", {0.98}), scale),
            "the sensor reads 2 % too little");
  EXPECT_EQ(EffectInWords(Made("sensor_offset", "", {-1200.0}), scale),
            "the sensor reads 1.2 kPa too low");
}

TEST(EffectWords, AWrongNumberIsSaidBesideTheDeclaredOne) {
  EXPECT_EQ(NumberInWords("source_pressure", 172.5, 149.9, "kpa_gauge"),
            "source pressure is 150 kPa gauge, 13 % less than declared");
  EXPECT_EQ(NumberInWords("expansion_ratio", 1.3, 1.995, "1"),
            "expansion ratio is 2, 53 % more than declared");
  EXPECT_EQ(NumberInWords("rest_volume", 50.0, 54.5, "ml"),
            "rest volume is 54.5 mL, 9 % more than declared");
  EXPECT_EQ(NumberInWords("ambient_pressure", 100.0, 89.7, "kpa_abs"),
            "ambient pressure is 89.7 kPa absolute, 10 % less than declared");
}

}  // namespace effect_words_test
}  // namespace plenum::api
