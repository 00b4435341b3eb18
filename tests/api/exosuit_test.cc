// The exosuit on the shipped catalogue, and its first design once more by masses of gas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>

#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "optimizer/explain/explained_search.h"
#include "optimizer/problem/problem.h"
#include "tests/support/mass_form.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace exosuit_test {

using test::MassElement;
using test::MassGroup;
using test::MassResult;
using test::MassRig;

template <typename Part>
const Part& Find(const std::vector<Part>& parts, const std::string& id) {
  return *std::find_if(parts.begin(), parts.end(), [&](const Part& part) {
    if constexpr (requires { part.per_metre; })
      return part.per_metre.id == id;
    else
      return part.basics.id == id;
  });
}

MassElement Element(const model::FlowElement& flow) {
  return {flow.sonic_conductance_m3_per_s_pa, flow.critical_ratio};
}

// First time at which the pressure has gone from one side of `target_pa` to the other.
double Crossing(const MassResult& result, double target_pa) {
  const std::vector<double>& p = result.pressure_pa[0];
  for (std::size_t i = 1; i < p.size(); ++i)
    if ((p[i - 1] < target_pa) != (p[i] < target_pa))
      return result.t_s[i - 1] +
             (result.t_s[i] - result.t_s[i - 1]) * (target_pa - p[i - 1]) / (p[i] - p[i - 1]);
  return -1.0;
}

TEST(Exosuit, FirstDesignRisesAndFallsAsTheMassesSay) {
  const std::filesystem::path root = test::SourceDir();
  std::ifstream file(root / "examples/exosuit.json");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const catalog::Store store(root / "catalog.db", catalog::Access::kRead);
  const auto parsed = ParseRequirements(std::get<Json>(ParseJson(text)), store.List());
  const optimizer::Problem& problem = std::get<DesignRequest>(parsed).problem;
  optimizer::SearchOptions options;
  options.time_limit_s = 120.0;
  const optimizer::Answer answer = optimizer::Search(problem, options);
  ASSERT_EQ(answer.status, optimizer::Status::kOptimal);
  const optimizer::Design& design = answer.designs.front();
  ASSERT_EQ(design.configuration, optimizer::Configuration::kCompressor);

  std::map<optimizer::Family, std::string> ids;
  double pumps = 0.0;
  for (const optimizer::Choice& choice : design.parts) {
    ids[choice.family] = choice.id;
    if (choice.family == optimizer::Family::kCompressor) pumps = choice.quantity;
  }
  const auto& tube = Find(problem.parts.tubing, ids[optimizer::Family::kTubing]);
  const auto& fitting = Find(problem.parts.fittings, ids[optimizer::Family::kFitting]);
  const auto& valve = Find(problem.parts.valves, ids[optimizer::Family::kValve]);
  const auto& pump = Find(problem.parts.compressors, ids[optimizer::Family::kCompressor]);

  // Tube by its published formula, in SI, afresh: 0.5 m.
  const double d = tube.inner_diameter_m;
  const double conductance = 0.029 * d * d / std::sqrt(0.5 / std::pow(d, 1.25) + 510.0);
  const MassElement bore{conductance, 474.0 * conductance / (d * d)};
  const double dead_m3 = std::numbers::pi / 4.0 * d * d * 0.5;
  MassGroup group;
  group.count = 6;
  group.operating_pa = 2e5;
  group.close_at_operating = true;
  group.volume_m3 = [=](double p) { return 50e-6 * (1.0 + (p - 1e5) / 1e5) + dead_m3; };
  group.fill = {Element(valve.fill), Element(fitting.flow), bore, Element(fitting.flow)};
  group.exhaust = {Element(fitting.flow), bore, Element(fitting.flow), Element(valve.exhaust)};
  group.schedule = {{0.0, 1}};

  MassRig rig;
  rig.linear_ratio = 1.0 - 1e-9;  // designs have none: their strokes end short of the source
  rig.groups = {group};
  rig.source = MassRig::Source::kReservoir;
  rig.source_pa = rig.stop_pa = design.settings.source_pressure_pa;
  rig.reservoir_m3 = *design.settings.reservoir_volume_m3;
  for (int i = 0; i <= 400; ++i) {
    const double p = 1e5 + (pump.curve.free_air_m3_per_s.back() - 1e5) * i / 400.0;
    rig.delivery.emplace_back(p, pumps * pump.curve.free_air_m3_per_s(p));
  }
  const optimizer::GroupPerformance& reported = design.performance.groups[0];
  EXPECT_NEAR(Crossing(test::SimulateMasses(rig, 1.0, 1e-4, 1e-3), 1.95e5), reported.rise_time_s,
              1e-5 * reported.rise_time_s);
  EXPECT_LE(reported.rise_time_s, 0.5);

  rig.source = MassRig::Source::kNone;
  rig.groups[0].initial_pa = 2e5;
  rig.groups[0].schedule = {{0.0, -1}};
  EXPECT_NEAR(Crossing(test::SimulateMasses(rig, 1.0, 1e-4, 1e-3), 1.05e5), reported.fall_time_s,
              1e-5 * reported.fall_time_s);
  EXPECT_LE(reported.fall_time_s, 0.6);
}

}  // namespace exosuit_test
}  // namespace plenum::api
