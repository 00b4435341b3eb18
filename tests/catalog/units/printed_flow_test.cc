#include "catalog/units/printed_flow.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/fields/csv.h"
#include "catalog/units/quantity.h"

namespace plenum::catalog {
namespace printed_flow_test {

using ::testing::HasSubstr;

double Read(const std::string& text, double b) {
  PrintedFlow printed;
  EXPECT_EQ(ReadPrintedFlow(text, printed), "") << text;
  return ConductanceOf(printed, b).conductance_dm3_per_s_bar;
}

struct Row {
  const char* text;
  double b, conductance;
};
void ExpectWithin(const std::vector<Row>& rows, double share) {
  for (const auto& [text, b, conductance] : rows)
    EXPECT_NEAR(Read(text, b) / conductance, 1.0, share) << text;
}

// By tests/catalog/units/printed_flow_oracle.py, which finds C by bisection on mass flows. Flows
// are those that the sheets of these valves print.
TEST(PrintedFlow, NominalFlowIsThatOfAnIndependentConversion) {
  ExpectWithin({{"Qn 8.4 L/min at 6 to 5 bar", 0.3, 0.033002},       // SMC V114
                {"Qn 10 L/min at 6 to 5 bar", 0.3, 0.039288},        // Festo MHA1
                {"qn 14 l/min", 0.3, 0.055003},                      // Festo MHA1 2/2
                {"Qn 92", 0.3, 0.361447},                            // SMC SYJ300
                {"Qn = 100 L/min at 6 → 5 bar", 0.3, 0.392877},      // Festo MHA2
                {"Qn: 220 L/min at 600 to 500 kPa", 0.3, 0.864330},  // Festo VUVG-L10
                {"Qn 329 L/min at 6 bar to 5 bar", 0.3, 1.292566},   // SMC SYJ500
                {"Qn 350 L/min at 0.6 to 0.5 MPa", 0.3, 1.375070},   // Festo CPE10
                {"Qn 560 L/min at 6->5 bar", 0.3, 2.200112},         // Festo VUVG-L14
                {"Qn 724 L/min at 6 to 5 bar", 0.3, 2.844431},       // SMC SYJ700
                {"Qn 1300 L/min at 6 to 5 bar", 0.3, 5.107403},      // Norgren 97
                {"Qn 60 L/min at 2 to 1 bar", 0.2, 0.409273},
                {"Qn 60 L/min at 6 to 0 bar", 0.4, 0.142592},
                {"Qn 3.5 scfm at 87 psi to 72.5 psi", 0.35, 0.376950}},
               1e-4);
}

// C, b and the nominal flow of one valve, all printed: SMC SY (ANR) and Festo (normal litres of
// DIN 1343).
TEST(PrintedFlow, NominalFlowIsThatOfSheetsThatPrintBoth) {
  ExpectWithin({{"Qn 276 L/min at 6 to 5 bar", 0.28, 1.1},          // SY3000
                {"Qn 746 L/min at 6 to 5 bar", 0.37, 2.8},          // SY5000
                {"Qn 1130 L/min at 6 to 5 bar", 0.28, 4.5},         // SY7000
                {"Qn 2527 L/min at 6 to 5 bar", 0.29, 10},          // SY9000
                {"Qn 1000 Nl/min (0 °C) at 6 to 5 bar", 0.3, 4.3},  // VUVS-L25
                {"Qn 1400 Nl/min (0 °C)", 0.23, 6.25}},             // MPYE-5-1/4
               0.01);
}

// The rule C = 4 Cv, as printed by SMC for SY9000 and DXT474; others by hand.
TEST(PrintedFlow, CvAndKvFollowTheirRule) {
  ExpectWithin({{"Cv 2.5", 0.29, 10},
                {"Cv 1.2", 0.3, 4.8},
                {"Cv 0.008", 0.3, 0.032},
                {"Cv 0.014", 0.3, 0.056},
                {"Cv 0.02", 0.3, 0.08},
                {"Cv 0.025", 0.3, 0.1},
                {"cv=0.05", 0.3, 0.2},
                {"CV 0,055", 0.3, 0.22},
                {"Cv 0.08", 0.3, 0.32},
                {"Cv 0.19", 0.3, 0.76},
                {"Cv 0.3", 0.3, 1.2},
                {"Cv 0.78", 0.3, 3.12}},
               1e-9);
  // Kv = 0.865 Cv: the same valves by the number that European makers print.
  ExpectWithin({{"Kv 2.1625", 0.29, 10},
                {"Kv 1.038", 0.3, 4.8},
                {"Kv 0.00692", 0.3, 0.032},
                {"Kv 0.01211", 0.3, 0.056},
                {"Kv 0.0173", 0.3, 0.08},
                {"Kv 0.021625", 0.3, 0.1},
                {"Kv 0.04325", 0.3, 0.2},
                {"Kv 0.047575", 0.3, 0.22},
                {"Kv 0.0692", 0.3, 0.32},
                {"Kv 0.16435", 0.3, 0.76},
                {"Kv 0.2595", 0.3, 1.2},
                {"Kv 0.6747", 0.3, 3.12}},
               1e-9);
}

// SMC prints the effective areas of KQG fittings; JIS B 8390: S = 5 C. The ideal nozzle, 0.19863
// dm³/(s·bar) per mm² by printed_flow_oracle.py, is within 1 % of that.
TEST(PrintedFlow, EffectiveAreaIsThatOfANozzle) {
  for (const double area : {0.9, 1.8, 2.7, 4.0, 4.6, 5.6, 10.4, 13.1, 26.1, 58.3, 60.0}) {
    const std::string text = "effective area " + std::to_string(area) + " mm2";
    EXPECT_NEAR(Read(text, 0.3) / (0.19862961671 * area), 1.0, 0.01);
  }
  EXPECT_DOUBLE_EQ(Read("effective area 0.1 cm2", 0.3), 2.0);
}

// Bores of an inch table; 0.8 of the ideal nozzle, within 1 %. CKD prints C for the bores of its
// AB21: the rule is right within 15 %.
TEST(PrintedFlow, OrificeIsFourFifthsOfTheIdealNozzle) {
  constexpr double kQuarterPi = 0.78539816339744831;
  for (const double bore : {0.5, 0.762, 1.016, 1.27, 1.5, 2.0, 2.032, 3.0, 4.0, 5.0, 8.0})
    EXPECT_NEAR(Read("orifice " + std::to_string(bore) + " mm", 0.3) /
                    (0.8 * 0.19862961671 * kQuarterPi * bore * bore),
                1.0, 0.01);
  ExpectWithin({{"orifice 1.5 mm", 0.3, 0.29},
                {"orifice 2 mm", 0.3, 0.53},
                {"orifice 3 mm", 0.3, 1.1},
                {"orifice 4 mm", 0.3, 1.8}},
               0.15);
  EXPECT_DOUBLE_EQ(Read("orifice 0.05 in", 0.3), Read("orifice 1.27 mm", 0.3));
}

TEST(PrintedFlow, SaysWhatIsWrong) {
  const auto error = [](const char* text) {
    PrintedFlow printed;
    return ReadPrintedFlow(text, printed);
  };
  EXPECT_THAT(error("Qn 100 Nl/min"), HasSubstr("0 °C or at 20 °C"));
  EXPECT_THAT(error("Qn 100 L/min at 5 to 6 bar"), HasSubstr("must be like \"6 to 5 bar\""));
  EXPECT_THAT(error("Qn 100 L/min at 6"), HasSubstr("is \"6\""));
  EXPECT_THAT(error("Cv -1"), HasSubstr("Cv must be between 1e-06 and 1000, is -1"));
  EXPECT_THAT(error("orifice 3 kg"), HasSubstr("orifice must be a finite number"));
  EXPECT_FALSE(IsPrintedFlow("0.3 dm3/(s bar)"));
  EXPECT_FALSE(IsPrintedFlow("Cvx 3"));
}

TEST(PrintedFlow, StandsInACellOfCsv) {
  const CsvParts read =
      ReadCsv("fitting",
              "id,manufacturer,part_number,tube_outer_diameter_mm,sonic_conductance_dm3_per_s_bar,"
              "sonic_conductance_dm3_per_s_bar.source,critical_ratio,mass_kg,body_volume_ml,"
              "pressure_max_kpa_gauge,thread\n"
              "f1,me,F1,4 mm,\"Qn 276 L/min at 6 to 5 bar\",sheet 7,0.28,3 g,1 cc,7 bar,M5\n");
  ASSERT_TRUE(read.errors.empty()) << read.errors.front().detail;
  const Number& number = read.parts.front().numbers.at("sonic_conductance_dm3_per_s_bar");
  EXPECT_NEAR(number.value, 1.1, 0.01);
  EXPECT_EQ(number.provenance, Provenance::kDerived);
  EXPECT_EQ(number.source,
            "C = Qn/(60·p1·√(1−((p2/p1−b)/(1−b))²)), Qn 276 L/min from 6 to 5 bar gauge, b 0.28; "
            "sheet 7");
}

}  // namespace printed_flow_test
}  // namespace plenum::catalog
