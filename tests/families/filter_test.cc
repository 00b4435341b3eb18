// What follows from the table of a family's fields, shown with one that plenum does not have.
#include "tests/families/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "api/catalogue/families.h"
#include "api/catalogue/part_document.h"
#include "api/describe/descriptions.h"
#include "api/design/proof_record.h"
#include "api/design/read/selection.h"
#include "catalog/fields/csv.h"
#include "optimizer/choices/box_tree.h"
#include "optimizer/choices/plant/compared.h"
#include "optimizer/problem/family_specs.h"
#include "tests/catalog/samples.h"
#include "tests/support/small_catalogue.h"
#include "verify/corner/verify_best.h"
#include "verify/corner/verify_dominance.h"
#include "verify/tree/verify_tree.h"

namespace plenum::test {
namespace filter_test {

using api::Json;
using optimizer::Configuration;
using optimizer::Contender;
using optimizer::Item;
using optimizer::PartNumbers;
using optimizer::Problem;
using optimizer::ProofItem;
using optimizer::ProofPlan;
using optimizer::ProofSlot;
using verify::BestNumbers;
using verify::Findings;

const catalog::Family& Table() { return *catalog::FindFamily("filter"); }

// Few different values, so that many are no worse than another.
void DrawFilters(std::uint64_t seed, int count) {
  Random random(seed);
  Filters().clear();
  for (int i = 0; i < count; ++i)
    Filters().push_back({{"m" + std::to_string(i), 0.01 * Pick(random, 1, 40), 1e-5, 2.0},
                         Chance(random, 0.5) ? "M5" : "G1/8",
                         {1e-8 * Pick(random, 1, 4), 0.1 * Pick(random, 1, 3)},
                         1e5 * Pick(random, 4, 7)});
}

Problem MassProblem(int count) {
  Problem problem = EasyProblem(1, {Configuration::kMains});
  problem.objective = {.mass_kg = 1.0};
  problem.count = count;
  return problem;
}

struct Choices {
  std::vector<Item<FilterCorner>> items;
  std::vector<Contender> contenders;
};

// As the search makes them of a family of the source.
Choices MakeChoices(const Problem& problem, bool equal_flow, double useful_max_pa) {
  const optimizer::FamilySpec& spec = optimizer::SpecOf(kFilter);
  Choices choices;
  optimizer::MatingClasses classes;
  for (int i = 0; i < optimizer::FamilySize(problem.parts, kFilter); ++i) {
    const PartNumbers numbers{problem.parts, i, 1.0, useful_max_pa};
    const model::PartBasics& basics = optimizer::BasicsOf(problem.parts, kFilter, i);
    Item<FilterCorner>& item = choices.items.emplace_back();
    item.option = {i, 1, optimizer::operator*(1.0, basics)};
    item.corner.amounts = item.option.amounts;
    item.corner.objective = ObjectiveOf(problem.objective, item.option.amounts);
    item.corner.threads = Filters()[i].thread == "M5" ? 1 : 2;
    SetNumbers(numbers, item.corner);
    Contender& contender = choices.contenders.emplace_back();
    contender.item = {i, 1};
    contender.id = basics.id;
    contender.objective = item.corner.objective;
    contender.mates = classes.Of(numbers, spec.fields, true);
    AddLosses(numbers, spec.fields,
              equal_flow ? optimizer::EqualFlow::kShared : optimizer::EqualFlow::kNever,
              contender.losses);
  }
  return choices;
}

// The rule in words: the same thread, no less flow (the same where lines share it), stands no less,
// and lighter, or as heavy with the earlier id.
bool IsBetter(const Filter& a, const Filter& b, bool equal_flow) {
  const auto& [c, ratio, m, cracking] = a.flow;
  const auto& [other_c, other_ratio, other_m, other_cracking] = b.flow;
  const bool flows =
      equal_flow ? c == other_c && ratio == other_ratio : c >= other_c && ratio >= other_ratio;
  const bool lighter = a.basics.mass_kg != b.basics.mass_kg ? a.basics.mass_kg < b.basics.mass_kg
                                                            : a.basics.id < b.basics.id;
  return a.thread == b.thread && flows && a.pressure_max_pa >= b.pressure_max_pa && lighter;
}

TEST(Filter, StandsAtItsNumber) {
  EXPECT_EQ(optimizer::Families()[static_cast<std::size_t>(kFilter)].family, kFilter);
}

TEST(Filter, GoesThroughCsv) {
  std::mt19937 random(7);
  std::vector<catalog::Part> parts;
  parts.reserve(20);
  for (int i = 0; i < 20; ++i)
    parts.push_back(catalog::AnyPart(Table(), "m" + std::to_string(i), random));
  const std::string text = catalog::WriteCsv("filter", parts);
  const catalog::CsvParts read = catalog::ReadCsv("filter", text);
  ASSERT_TRUE(read.errors.empty()) << read.errors.front().detail;
  EXPECT_EQ(read.parts, parts);

  parts[0].numbers["critical_ratio"].value = 2.0;
  const catalog::CsvParts refused =
      catalog::ReadCsv("filter", catalog::WriteCsv("filter", {parts[0]}));
  ASSERT_EQ(refused.errors.size(), 1u);
  EXPECT_EQ(refused.errors[0].column, "critical_ratio");
}

TEST(Filter, GoesThroughJsonAndIsDescribed) {
  std::mt19937 random(8);
  for (int i = 0; i < 20; ++i) {
    catalog::Part part = catalog::AnyPart(Table(), "m" + std::to_string(i), random);
    part.manufacturer = part.part_number = "Maker";
    const auto parsed = api::ParsePart(api::RenderPart(part));
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed));
    EXPECT_EQ(std::get<catalog::Part>(parsed), part);
  }
  const Json families = api::RenderFamilies().at("families");
  const auto found = std::find_if(families.begin(), families.end(),
                                  [](const Json& family) { return family["name"] == "filter"; });
  ASSERT_NE(found, families.end());
  std::map<std::string, Json> search;
  for (const char* kind : {"numbers", "texts"})
    for (const Json& field : (*found)[kind]) search[field["name"]] = field["search"];
  EXPECT_EQ(search["mass_kg"], "adds up");
  EXPECT_EQ(search["sonic_conductance_dm3_per_s_bar"],
            "more is better, but takes air from other lines");
  EXPECT_EQ(search["critical_ratio"], search["sonic_conductance_dm3_per_s_bar"]);
  EXPECT_EQ(search["thread"], "decides what fits");
  EXPECT_EQ(search["material"], nullptr);
  const std::string form = api::DescribePart().dump();
  EXPECT_NE(form.find("\"filter\""), std::string::npos);
}

TEST(Filter, IsSelectedByRequests) {
  catalog::Part part;
  part.id = "m1";
  part.family = "filter";
  Problem problem = MassProblem(1);
  api::Errors errors;
  const Json request = {{"require", {{"filter", {"m1"}}}}};
  api::Reader reader(request, "", errors);
  api::ReadSelection(reader, {part}, problem);
  EXPECT_TRUE(errors.empty());
  EXPECT_EQ(problem.require.at(kFilter), std::set<std::string>{"m1"});
  EXPECT_EQ(api::AllowedParts({part}, problem).size(), 1u);
}

TEST(Filter, DominanceIsTheSameInSearchAndVerify) {
  const int count = 2;
  const Problem problem = MassProblem(count);
  int left_out = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const bool equal_flow : {false, true}) {
      DrawFilters(seed, 60);
      const Choices choices = MakeChoices(problem, equal_flow, optimizer::kUnlimited);
      const optimizer::Skyband skyband = KeepBest(choices.contenders, count, 1e-9, true);
      const std::set<int> kept(skyband.kept.begin(), skyband.kept.end());
      ProofPlan plan;
      plan.equal_flow = equal_flow;
      plan.tie = 1e-9;
      const ProofSlot slot{kFilter, -1, {}, {}};
      for (int b = 0; b < 60; ++b) {
        int checked = 0, by_words = 0;
        for (int a = 0; a < 60; ++a) {
          checked += verify::Dominates(problem, plan, slot, {a, 1}, {b, 1});
          by_words += IsBetter(Filters()[a], Filters()[b], equal_flow);
        }
        ASSERT_EQ(checked, by_words) << seed << " " << b;
        ASSERT_EQ(kept.contains(b), by_words < count) << seed << " " << b;
        left_out += by_words >= count;
      }
    }
  EXPECT_GT(left_out, 200);
}

TEST(Filter, CornersOfBoxesAreTheBestOfTheirChoices) {
  const Problem problem = MassProblem(1);
  const double useful_pa = 5.5e5;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    DrawFilters(seed, 40);
    const Choices choices = MakeChoices(problem, false, useful_pa);
    std::vector<const Item<FilterCorner>*> items;
    for (const auto& item : choices.items) items.push_back(&item);
    const optimizer::BoxTree<FilterCorner> tree = optimizer::MakeBoxTree(items);
    ProofPlan plan;
    plan.slots.push_back({kFilter, -1, {}, {}});
    for (const optimizer::Option& option : tree.options)
      plan.slots[0].choices.push_back({option.index, 1});
    for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
      FilterCorner best;
      best.objective = optimizer::kUnlimited;
      for (int i = tree.nodes[n].first; i < tree.nodes[n].last; ++i) {
        const Filter& one = Filters()[tree.options[i].index];
        best.objective = std::min(best.objective, one.basics.mass_kg);
        best.threads |= one.thread == "M5" ? 1 : 2;
        best.flow.sonic_conductance_m3_per_s_pa = std::max(best.flow.sonic_conductance_m3_per_s_pa,
                                                           one.flow.sonic_conductance_m3_per_s_pa);
        best.flow.critical_ratio = std::max(best.flow.critical_ratio, one.flow.critical_ratio);
        best.pressure_max_pa = std::max(best.pressure_max_pa, one.pressure_max_pa);
      }
      const FilterCorner& corner = tree.corners[n];
      EXPECT_EQ(corner.objective, best.objective);
      EXPECT_EQ(corner.threads, best.threads);
      EXPECT_EQ(corner.flow, best.flow);
      EXPECT_EQ(corner.pressure_max_pa, std::min(best.pressure_max_pa, useful_pa));
      const BestNumbers checked(problem, plan, {{tree.nodes[n].first, tree.nodes[n].last}}, 0);
      EXPECT_EQ(checked.Flow("sonic_conductance_dm3_per_s_bar"), best.flow);
      EXPECT_EQ(checked.Number("pressure_max_kpa_gauge"), best.pressure_max_pa);
    }
    // The first division is between those that mate with different parts.
    EXPECT_NE(tree.corners[tree.nodes[0].left].threads, tree.corners[tree.nodes[0].right].threads);
  }
}

// A plan of the mains with every choice, and the filters as a search would list them.
ProofPlan PlanWith(const Problem& problem, const optimizer::Skyband& skyband) {
  ProofPlan plan = verify::EmptyPlan(problem, {Configuration::kMains});
  plan.tie = 1e-9;
  for (ProofSlot& slot : plan.slots) {
    slot.choices = verify::EntriesOf(problem, {plan.configuration}, slot);
    if (slot.family != kFilter) continue;
    slot.choices.clear();
    for (const int i : skyband.kept) slot.choices.push_back({i, 1});
    slot.dominated = skyband.left_out;
  }
  return plan;
}

std::vector<std::string> ChecksOf(const Problem& problem, const ProofPlan& plan) {
  optimizer::Pruned counts;
  Findings findings;
  verify::CheckSlots(problem, plan, counts, findings);
  std::vector<std::string> checks;
  for (const verify::Finding& finding : findings) checks.push_back(finding.check);
  return checks;
}

TEST(Filter, VerifyChecksItsSlot) {
  const Problem problem = MassProblem(1);
  DrawFilters(3, 30);
  const Choices choices = MakeChoices(problem, false, optimizer::kUnlimited);
  const ProofPlan plan = PlanWith(problem, KeepBest(choices.contenders, 1, 1e-9, true));
  ProofPlan changed = plan;
  EXPECT_TRUE(ChecksOf(problem, plan).empty());
  EXPECT_EQ(changed.slots.back().family, kFilter);
  changed.slots.back().choices.pop_back();
  EXPECT_EQ(ChecksOf(problem, changed), std::vector<std::string>{"choices"});

  changed = plan;
  optimizer::ProofDominated& first = changed.slots.back().dominated.at(0);
  for (const ProofItem& kept : changed.slots.back().choices)
    if (!IsBetter(Filters()[kept.part], Filters()[first.item.part], false))
      first.dominators = {kept};
  EXPECT_EQ(ChecksOf(problem, changed), std::vector<std::string>{"dominance"});

  changed = plan;
  changed.slots.pop_back();
  EXPECT_EQ(ChecksOf(problem, changed), std::vector<std::string>{"choices"});

  const optimizer::BigCount with = verify::Combinations(problem, {Configuration::kMains});
  Filters().resize(10);
  EXPECT_EQ(verify::Combinations(problem, {Configuration::kMains}) * 3, with);
}

TEST(Filter, GoesThroughTheRecord) {
  const Problem problem = MassProblem(1);
  DrawFilters(4, 30);
  const Choices choices = MakeChoices(problem, false, optimizer::kUnlimited);
  optimizer::ProofRecord record;
  record.count = 1;
  record.plans.push_back(PlanWith(problem, KeepBest(choices.contenders, 1, 1e-9, true)));
  const Json text = Json::parse(api::RenderRecord(record, problem.parts).dump());
  api::Errors errors;
  api::Reader reader(text, "", errors);
  const optimizer::ProofRecord read = api::ReadRecord(reader, problem.parts);
  ASSERT_TRUE(errors.empty()) << errors.front().pointer << " " << errors.front().detail;
  ASSERT_EQ(read.plans.at(0).slots.size(), record.plans[0].slots.size());
  const ProofSlot &slot = read.plans[0].slots.back(), &given = record.plans[0].slots.back();
  EXPECT_EQ(slot.family, kFilter);
  EXPECT_EQ(slot.choices, given.choices);
  ASSERT_EQ(slot.dominated.size(), given.dominated.size());
  ASSERT_FALSE(slot.dominated.empty());
  for (std::size_t i = 0; i < slot.dominated.size(); ++i) {
    EXPECT_EQ(slot.dominated[i].item, given.dominated[i].item);
    EXPECT_EQ(slot.dominated[i].dominators, given.dominated[i].dominators);
  }
  EXPECT_TRUE(ChecksOf(problem, read.plans[0]).empty());
}

TEST(Filter, RowsOfTheCatalogueBecomeParts) {
  std::mt19937 random(9);
  const model::Ambient ambient;
  const catalog::Part row = catalog::AnyPart(Table(), "m", random);
  Filters() = {ToFilter(row, ambient)};
  const optimizer::FamilySpec& spec = optimizer::SpecOf(kFilter);
  EXPECT_STREQ(optimizer::Name(kFilter), "filter");
  EXPECT_EQ(optimizer::FindPart({}, kFilter, "m"), 0);
  for (const optimizer::PartField& field : spec.fields) {
    const optimizer::FieldValue value = field.of({}, 0);
    if (field.name == "thread") {
      EXPECT_EQ(std::get<std::string_view>(value), row.texts.at("thread").value);
    } else if (field.name == "pressure_max_kpa_gauge") {
      EXPECT_DOUBLE_EQ(std::get<double>(value),
                       ambient.pressure_pa + 1e3 * row.numbers.at("pressure_max_kpa_gauge").value);
    } else {
      EXPECT_DOUBLE_EQ(std::get<model::FlowElement>(value).sonic_conductance_m3_per_s_pa,
                       1e-8 * row.numbers.at("sonic_conductance_dm3_per_s_bar").value);
    }
  }
}

}  // namespace filter_test
}  // namespace plenum::test
