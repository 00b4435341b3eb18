#include "calibration/learn/slips.h"

#include <gtest/gtest.h>

#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace {

using Record = Run;  // inside a test Run is the test's own
using test::EffectRig;
using test::MeasuredBench;

std::vector<std::string> After(const std::function<void(Run&)>& slip, std::size_t first = 0,
                               std::size_t last = 4) {
  Dataset record = MeasuredBench(nullptr, 31);
  for (std::size_t i = first; i < last; ++i) slip(record.runs[i]);
  return SuspectedSlips(record, nullptr);
}

void Scale(Run& run, double factor) {
  for (double& pa : run.pressure_pa) pa = 1e5 + factor * (pa - 1e5);
}

void Invert(Run& run) {
  for (model::ValveCommand& command : run.valve) {
    if (command.state == model::ValveState::kInflate)
      command.state = model::ValveState::kDeflate;
    else if (command.state == model::ValveState::kDeflate)
      command.state = model::ValveState::kInflate;
  }
}

void ExpectOne(const std::vector<std::string>& found, const std::string& words) {
  ASSERT_EQ(found.size(), 1u) << words;
  EXPECT_NE(found[0].find(words), std::string::npos) << found[0];
}

TEST(Slips, OfUnitsAreSuspected) {
  ExpectOne(After([](Record& run) { Scale(run, 0.01); }), "the runs fit");
  ExpectOne(After([](Record& run) { Scale(run, 0.01); }), "in bar");
  ExpectOne(After([](Record& run) { Scale(run, 0.001); }), "in MPa");
  ExpectOne(After([](Record& run) { Scale(run, 1.0 / 6.894757); }), "in psi");
  ExpectOne(After([](Record& run) { Scale(run, 1000.0); }), "in Pa");
  ExpectOne(After([](Record& run) {
              for (double& pa : run.pressure_pa) pa += 1e5;
            }),
            "readings are absolute");
  ExpectOne(After([](Record& run) { run.source_pressure_pa += 1e5; }),
            "source pressure is absolute");
  ExpectOne(After([](Record& run) {
              for (double& t_s : run.t_s) t_s *= 1000.0;
            }),
            "times of the readings are in ms");
  ExpectOne(After([](Record& run) {
              for (model::ValveCommand& command : run.valve) command.time_s *= 1000.0;
            }),
            "times of the commands are in ms");
  ExpectOne(After([](Record& run) { run.chamber.rest_volume_m3 /= 1000.0; }), "in litres");
}

TEST(Slips, OfCommandsAreSuspectedInTheRunsThatHaveThem) {
  ExpectOne(After(Invert), "the runs fit the declared model far better if inflate and deflate");
  ExpectOne(After(Invert, 1, 2), "run high fits");
}

TEST(Slips, RunsWithExchangedReadingsAreNamed) {
  Dataset record = MeasuredBench(nullptr, 32);
  for (model::ValveCommand& command : record.runs[1].valve) command.time_s += 1.0;
  for (std::size_t i = 0; i < 2; ++i) test::Measure(nullptr, 33 + i, 150.0, record.runs[i]);
  ASSERT_TRUE(SuspectedSlips(record, nullptr).empty());
  std::swap(record.runs[0].pressure_pa, record.runs[1].pressure_pa);
  ExpectOne(SuspectedSlips(record, nullptr), "runs low and high");
}

TEST(Slips, MissingPhysicsIsNone) {
  EXPECT_TRUE(SuspectedSlips(MeasuredBench(nullptr, 34), nullptr).empty());
  const std::vector<test::Change> changes = {[](EffectRig& rig) { rig.heat_time_constant_s = 2.0; },
                                             [](EffectRig& rig) {
                                               rig.leak = test::OrificeLeak{0.02e-8, 0.3};
                                             },
                                             [](EffectRig& rig) { rig.valve_delay_s = 0.4; },
                                             [](EffectRig& rig) { rig.dead_volume_m3 = 50e-6; },
                                             [](EffectRig& rig) { rig.sensor_offset_pa = 3e4; },
                                             [](EffectRig& rig) { rig.cracking_pa = 4e4; }};
  for (const test::Change& change : changes)
    EXPECT_TRUE(SuspectedSlips(MeasuredBench(change, 35), nullptr).empty());
}

}  // namespace
}  // namespace plenum::calibration
