#include "api/design/read/tolerance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "optimizer/problem/problem.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace tolerance_test {

using catalog::Provenance;

TEST(Factor, IsUniformWithinItsHalfWidth) {
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 20000;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double factor = Factor(7, draw, "valve-1", "mass_kg", 0.3);
    EXPECT_GE(factor, 0.7);
    EXPECT_LE(factor, 1.3);
    sum += factor - 1.0;
    squares += (factor - 1.0) * (factor - 1.0);
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 * 0.3 / std::sqrt(3.0 * kDraws));
  EXPECT_NEAR(squares / kDraws, 0.3 * 0.3 / 3.0, 0.03 * 0.3 * 0.3 / 3.0);
}

TEST(Factor, DependsOnEachArgument) {
  const double factor = Factor(1, 2, "a", "mass_kg", 0.1);
  EXPECT_EQ(Factor(1, 2, "a", "mass_kg", 0.1), factor);
  EXPECT_NE(Factor(2, 2, "a", "mass_kg", 0.1), factor);
  EXPECT_NE(Factor(1, 3, "a", "mass_kg", 0.1), factor);
  EXPECT_NE(Factor(1, 2, "b", "mass_kg", 0.1), factor);
  EXPECT_NE(Factor(1, 2, "a", "price_eur", 0.1), factor);
}

// Two numbers of one part, or one of two parts, have nothing to do with each other.
TEST(Factor, NumbersAreUncorrelated) {
  const auto correlation = [](const char* id, const char* field) {
    double product = 0.0, square = 0.0;
    for (int draw = 0; draw < 20000; ++draw) {
      const double a = Factor(1, draw, "a", "mass_kg", 1.0) - 1.0;
      product += a * (Factor(1, draw, id, field, 1.0) - 1.0);
      square += a * a;
    }
    return product / square;
  };
  EXPECT_NEAR(correlation("a", "mass_kg"), 1.0, 1e-12);
  EXPECT_NEAR(correlation("b", "mass_kg"), 0.0, 0.03);
  EXPECT_NEAR(correlation("a", "coil_power_w"), 0.0, 0.03);
}

TEST(Perturbed, KeepsToTheToleranceOfEachNumber) {
  const Tolerance tolerance{0.01, 0.02, 0.04, 0.08};
  catalog::Part row = PartOf("valve");
  row.numbers["mass_kg"].provenance = Provenance::kDatasheet;
  row.numbers["body_volume_ml"].provenance = Provenance::kThirdParty;
  row.numbers["coil_power_w"].provenance = Provenance::kDerived;
  row.numbers["pressure_max_kpa_gauge"].provenance = Provenance::kEstimated;
  double largest[4] = {};
  for (int draw = 0; draw < 500; ++draw) {
    const catalog::Part drawn = Perturbed(row, tolerance, 1, draw);
    EXPECT_EQ(drawn.numbers.at("channels"), row.numbers.at("channels"));
    EXPECT_EQ(drawn.texts, row.texts);
    int i = 0;
    for (const char* field :
         {"mass_kg", "body_volume_ml", "coil_power_w", "pressure_max_kpa_gauge"}) {
      const double off = drawn.numbers.at(field).value / row.numbers.at(field).value - 1.0;
      largest[i] = std::max(largest[i], std::abs(off));
      ++i;
    }
  }
  const double half_widths[] = {0.01, 0.02, 0.04, 0.08};
  for (int i = 0; i < 4; ++i) {
    EXPECT_LE(largest[i], half_widths[i] * (1.0 + 1e-9));
    EXPECT_GE(largest[i], half_widths[i] * 0.95);
  }
}

TEST(Tolerance, AnUncertaintyComesBeforeTheProvenance) {
  const Tolerance tolerance{0.01, 0.02, 0.04, 0.08, 0.03};
  EXPECT_EQ(tolerance.Of(Provenance::kMeasured), 0.03);
  EXPECT_EQ(tolerance.Of(Provenance::kMeasured, std::nullopt), 0.03);
  EXPECT_EQ(tolerance.Of(Provenance::kMeasured, 0.1), 0.2);
  EXPECT_EQ(tolerance.Of(Provenance::kEstimated, 0.7), 0.95);  // a factor stays above 0
}

TEST(Perturbed, ScalesAPumpsCurveAsAWholeAndStaysInRange) {
  catalog::Part row = PartOf("compressor");
  row.numbers["duty_max"] = {1.0, Provenance::kEstimated, ""};
  row.curve->free_air_provenance = Provenance::kEstimated;
  bool below = false;
  for (int draw = 0; draw < 50; ++draw) {
    const catalog::Part drawn = Perturbed(row, {}, 1, draw);
    EXPECT_TRUE(catalog::Part(drawn).curve.has_value());
    const double factor =
        drawn.curve->points[0].free_air_l_per_min / row.curve->points[0].free_air_l_per_min;
    EXPECT_NE(factor, 1.0);
    for (std::size_t i = 0; i < row.curve->points.size(); ++i) {
      EXPECT_NEAR(drawn.curve->points[i].free_air_l_per_min,
                  factor * row.curve->points[i].free_air_l_per_min, 1e-12);
      EXPECT_EQ(drawn.curve->points[i].pressure_kpa_gauge, row.curve->points[i].pressure_kpa_gauge);
    }
    EXPECT_EQ(drawn.numbers.at("voltage_v"), row.numbers.at("voltage_v"));
    EXPECT_LE(drawn.numbers.at("duty_max").value, 1.0);
    below |= drawn.numbers.at("duty_max").value < 0.8;
  }
  EXPECT_TRUE(below);
}

TEST(MakeDraws, AMadeReservoirKeepsItsVolumeWithinADataSheetsTolerance) {
  const auto rows = SmallCatalogue();
  const DesignRequest request = std::get<DesignRequest>(ParseRequirements(Requirements(), rows));
  optimizer::Design design;
  design.configuration = optimizer::Configuration::kCompressor;
  design.parts = {{optimizer::Family::kTubing, "tubing-1", 0, 3.0, 0.027, 3.77e-5, 2.4},
                  {optimizer::Family::kReservoir, "custom", -1, 1, 0.2, 800e-6, std::nullopt}};
  design.settings.reservoir_volume_m3 = 700e-6;
  const optimizer::DrawParts draws = MakeDraws(rows, request.problem, {}, 1);
  for (int draw = 0; draw < 50; ++draw) {
    const model::Parts parts = draws(design, draw);
    EXPECT_EQ(parts.tubing.size(), 1u);
    EXPECT_TRUE(parts.valves.empty());
    ASSERT_EQ(parts.reservoirs.size(), 1u);
    EXPECT_EQ(parts.reservoirs[0].basics.id, "custom");
    EXPECT_NEAR(parts.reservoirs[0].volume_m3, 700e-6, 0.05 * 700e-6 * (1.0 + 1e-9));
    EXPECT_NEAR(parts.reservoirs[0].basics.mass_kg, 0.2, 0.25 * 0.2 * (1.0 + 1e-9));
  }
}

TEST(Robust, RequestsAreReadAndAnswered) {
  Json requirements = Requirements();
  requirements["robust"] = Parse(R"({"draws": 30, "seed": 4, "tolerance": {"estimated": 0.4}})");
  requirements["ranking"]["probability_min"] = 0.5;
  const auto rows = SmallCatalogue();
  const DesignRequest request = std::get<DesignRequest>(ParseRequirements(requirements, rows));
  ASSERT_TRUE(request.robust.has_value());
  EXPECT_EQ(request.robust->tolerance, (Tolerance{0.05, 0.10, 0.10, 0.4}));
  optimizer::RobustAnswer result;
  result.answer.designs.resize(1);
  result.robustness = {{20, 5}};
  result.draws = 25;
  result.below = 3;
  Json document = {{"designs", Json::array({Json::object()})}};
  AddRobustness(*request.robust, result, document);
  const Json& robustness = document["designs"][0]["robustness"];
  EXPECT_EQ(robustness["probability"], 0.8);
  EXPECT_EQ(robustness["share_rank_1"], 0.2);
  // Wilson 95 % of 20 in 25, from tables.
  EXPECT_NEAR(robustness["probability_ci95"][0].get<double>(), 0.6087, 1e-4);
  EXPECT_NEAR(robustness["probability_ci95"][1].get<double>(), 0.9114, 1e-4);
  EXPECT_EQ(document["robust"], Parse(R"({"draws": 25, "draws_asked": 30, "seed": 4,
    "tolerance": {"datasheet": 0.05, "third_party": 0.1, "derived": 0.1, "estimated": 0.4,
                  "measured": 0.02},
    "probability_min": 0.5, "left_out": 3})"));
}

TEST(Robust, ALeastProbabilityAloneAsksForDraws) {
  Json requirements = Requirements();
  const auto rows = SmallCatalogue();
  EXPECT_FALSE(std::get<DesignRequest>(ParseRequirements(requirements, rows)).robust);
  requirements["ranking"]["probability_min"] = 0.9;
  const DesignRequest request = std::get<DesignRequest>(ParseRequirements(requirements, rows));
  ASSERT_TRUE(request.robust.has_value());
  EXPECT_EQ(request.robust->options.probability_min, 0.9);
  EXPECT_EQ(request.robust->options.draws, 200);
}

}  // namespace tolerance_test
}  // namespace plenum::api
