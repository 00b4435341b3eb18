#include "bench/loop/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "api/catalogue/stores.h"
#include "tests/support/places.h"

namespace plenum::bench {
namespace {

using Origin = catalog::Provenance;
constexpr int kDraws = 20'000;

std::vector<double> ErrorsOf(Origin provenance) {
  std::vector<double> errors;
  for (int i = 0; i < kDraws; ++i)
    errors.push_back(
        ErrorInDeviations("1/a/0", "part " + std::to_string(i), "mass_kg", provenance));
  return errors;
}

template <class Of>
double Share(const std::vector<double>& values, const Of& of) {
  return static_cast<double>(std::count_if(values.begin(), values.end(), of)) /
         static_cast<double>(values.size());
}

// Shares of a normal distribution between −3 and 3: 0.6845 within 1, 0.9571 within 2.
TEST(World, ErrorsAreNormalWithinThree) {
  const std::vector<double> errors = ErrorsOf(Origin::kDatasheet);
  EXPECT_NEAR(Share(errors, [](double z) { return z < 0.0; }), 0.5, 0.015);
  EXPECT_NEAR(Share(errors, [](double z) { return std::abs(z) < 1.0; }), 0.6845, 0.015);
  EXPECT_NEAR(Share(errors, [](double z) { return std::abs(z) < 2.0; }), 0.9571, 0.008);
  EXPECT_EQ(Share(errors, [](double z) { return std::abs(z) > 3.0; }), 0.0);
}

TEST(World, OfTheEstimatedFivePercentAreBeyondThree) {
  const std::vector<double> errors = ErrorsOf(Origin::kEstimated);
  EXPECT_NEAR(Share(errors, [](double z) { return std::abs(z) > 3.0; }), 0.05, 0.007);
  EXPECT_NEAR(Share(errors, [](double z) { return z > 3.0; }), 0.025, 0.005);
  EXPECT_EQ(Share(errors, [](double z) { return std::abs(z) > 4.0; }), 0.0);
}

catalog::Part APump() {
  catalog::Part pump;
  pump.id = "pump";
  pump.family = "compressor";
  pump.numbers["mass_kg"] = {0.3, Origin::kEstimated, "", {}};
  pump.numbers["duty_max"] = {0.5, Origin::kEstimated, "", 0.2};
  pump.numbers["nominal_voltage_v"] = {12.0, Origin::kEstimated, "", {}};
  pump.curve = {
      {{0, 10, 1}, {100, 6, 2}, {200, 0, 3}}, Origin::kEstimated, "", Origin::kDatasheet, ""};
  return pump;
}

TEST(World, FactorsFollowFromTheirErrors) {
  const catalog::Part pump = APump();
  const catalog::Part truth = DrawWorld({pump}, "w", Weights::kDrawn)[0];
  const auto factor = [&](const char* field, double deviation) {
    return std::exp(deviation * ErrorInDeviations("w", "pump", field, Origin::kEstimated));
  };
  EXPECT_NEAR(truth.numbers.at("mass_kg").value, 0.3 * factor("mass_kg", 0.125), 1e-12);
  EXPECT_NEAR(truth.numbers.at("duty_max").value, std::min(1.0, 0.5 * factor("duty_max", 0.2)),
              1e-12);
  EXPECT_EQ(truth.numbers.at("nominal_voltage_v").value, 12.0);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(truth.curve->points[i].free_air_l_per_min,
                pump.curve->points[i].free_air_l_per_min * factor("free_air", 0.125), 1e-12);
  EXPECT_LT(std::abs(truth.curve->points[0].current_a - 1.0), 0.08);
  const catalog::Part as_printed = DrawWorld({pump}, "w", Weights::kAsPrinted)[0];
  EXPECT_EQ(as_printed.numbers.at("mass_kg").value, 0.3);
  EXPECT_EQ(as_printed.numbers.at("duty_max"), truth.numbers.at("duty_max"));
  EXPECT_NE(DrawWorld({pump}, "v", Weights::kDrawn)[0], truth);
}

TEST(World, PartsOfTheCatalogueStayValid) {
  const auto rows = catalog::Store(test::SourceDir() / "catalog.db", catalog::Access::kRead).List();
  for (const catalog::Part& part : DrawWorld(rows, "w", Weights::kDrawn))
    for (const catalog::FieldError& error : catalog::Validate(part))
      ADD_FAILURE() << part.id << " " << error.field << ": " << error.detail;
}

}  // namespace
}  // namespace plenum::bench
