#include "calibration/learn/slips.h"

#include <gtest/gtest.h>

#include "calibration/diagnose.h"
#include "calibration/learn/slip_kinds.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace slips_test {

using Record = Run;  // inside a test Run is the test's own
using test::EffectRig;
using test::MeasuredBench;

std::vector<SuspectedSlip> After(const std::function<void(Run&)>& slip, std::size_t first = 0,
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

void ExpectOne(const std::vector<SuspectedSlip>& found, const std::string& words) {
  ASSERT_EQ(found.size(), 1u) << words;
  EXPECT_NE(found[0].what.find(words), std::string::npos) << found[0].what;
}

void Leak(EffectRig& rig) { rig.leak = test::OrificeLeak{0.0006e-8, 0.3}; }

void AllAbsolute(Record& run) {
  for (double& pa : run.pressure_pa) pa += 1e5;
  run.source_pressure_pa += 1e5;
  *run.initial_pressure_pa += 1e5;
}

// What is named once the record was settled in this way.
Diagnosis Settled(Dataset record, const std::string& assumption) {
  EXPECT_EQ(Settle(assumption, record), "");
  return Diagnose(record, {});
}

void ExpectLeak(const Diagnosis& d) {
  EXPECT_EQ(d.verdict, Verdict::kExplained) << d.sentence;
  ASSERT_EQ(d.effects.size(), 1u) << d.sentence;
  EXPECT_EQ(d.effects[0].effect.spec->id, "leak");
}

// Not a name before what is suspected is settled.
void ExpectUnsettled(const Diagnosis& d, const std::string& assume) {
  EXPECT_EQ(d.verdict, Verdict::kUndecided) << d.sentence;
  EXPECT_TRUE(d.effects.empty() && d.numbers.empty() && d.tied.empty() && !d.discrepancy);
  ASSERT_EQ(d.slips.size(), 1u) << d.sentence;
  EXPECT_EQ(d.slips[0].assume, assume);
  EXPECT_NE(d.sentence.find(assume), std::string::npos) << d.sentence;
  EXPECT_EQ(d.after.rms_pa, d.before.rms_pa);
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

// Small beside the pressures, so that what is declared does not show it: what fits does.
TEST(Slips, PressuresThatAreAllAbsoluteAreSettledBeforeAnEffectIsNamed) {
  Dataset record = MeasuredBench(Leak, 36);
  for (Record& run : record.runs) AllAbsolute(run);
  ExpectUnsettled(Diagnose(record, {}), "all_kpa_abs");
  ExpectLeak(Settled(record, "all kPa-abs"));
  const Diagnosis as_written = Settled(record, "as_written");
  EXPECT_TRUE(as_written.slips.empty());
  EXPECT_NE(as_written.verdict, Verdict::kExplained) << as_written.sentence;
}

TEST(Slips, RunsWithNearlyAlikeReadingsThatAreExchangedAreSettledToo) {
  Dataset record = MeasuredBench(Leak, 37);
  record.runs[1].source_pressure_pa = 3e5;
  test::Measure(Leak, 371, 150.0, record.runs[1]);
  std::swap(record.runs[0].pressure_pa, record.runs[1].pressure_pa);
  ASSERT_TRUE(SuspectedSlips(record, nullptr).empty());
  ExpectUnsettled(Diagnose(record, {}), "exchanged:low,high");
  ExpectLeak(Settled(record, "exchanged:low,high"));
}

// Read as absolute the chamber would be nearly empty, where all curves are alike in gauge.
TEST(Slips, AChamberThatEmptiesFromALittlePressureIsNoVacuum) {
  Dataset record = MeasuredBench(nullptr, 38);
  for (Record& run : record.runs) {
    run.supply = Supply::kNone;
    run.initial_pressure_pa = 1.3e5;
    run.valve = {{0.0, model::ValveState::kDeflate}};
    run.line[0].fill.sonic_conductance_m3_per_s_pa /= 4.0;  // not known, and far off
    run.line[0].exhaust = run.line[0].fill;
    test::Measure(
        [](EffectRig& rig) {
          rig.source = EffectRig::Source::kNone;
          rig.initial_pa = 1.3e5;
        },
        38, 20.0, run);
  }
  EXPECT_TRUE(SuspectedSlips(record, nullptr).empty());
}

TEST(Slips, AnAssumptionMustSaySomething) {
  Dataset record = MeasuredBench(nullptr, 39);
  EXPECT_NE(Settle("furlongs", record).find("psi"), std::string::npos);
  EXPECT_NE(Settle("psi:r7", record).find("r7"), std::string::npos);
  EXPECT_NE(Settle("exchanged:low", record).find("two runs"), std::string::npos);
  EXPECT_EQ(Settle("all_kpa_abs", record), "");
  EXPECT_NE(Settle("all_kpa_abs", record).find("vacuum"), std::string::npos);
  record = MeasuredBench(nullptr, 39);
  const std::vector<double> low = record.runs[0].pressure_pa, high = record.runs[1].pressure_pa;
  EXPECT_EQ(Settle("bar:low", record), "");
  EXPECT_DOUBLE_EQ(record.runs[0].pressure_pa[100], 1e5 + 100.0 * (low[100] - 1e5));
  EXPECT_EQ(record.runs[1].pressure_pa, high);
  EXPECT_FALSE(record.as_written);
  EXPECT_EQ(Settle("kPa gauge", record), "");
  EXPECT_TRUE(record.as_written);
  EXPECT_EQ(InWords("bar:low"), "the readings are in bar, not kPa (low)");
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

}  // namespace slips_test
}  // namespace plenum::calibration
