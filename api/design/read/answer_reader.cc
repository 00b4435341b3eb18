#include "api/design/read/answer_reader.h"

#include <cmath>

#include "api/design/proof_record.h"
#include "api/design/read/design_reader.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/power.h"
#include "api/json/request_limits.h"
#include "api/json/units.h"
#include "verify/verify.h"

namespace plenum::api {
namespace {

using optimizer::BigCount;
using optimizer::Choice;
using optimizer::Design;
using optimizer::Problem;

const Range kAnyNumber{-1e300, 1e300};
const Range kShare{0, 1};

// A decimal string, or a number up to 2⁵³.
BigCount ReadCount(Reader& reader, const char* field) {
  const Json* value = reader.Raw(field);
  if (value != nullptr && value->is_number_integer() && *value >= 0)
    return value->get<std::uint64_t>();
  if (value != nullptr && value->is_string()) {
    const std::string& digits = value->get_ref<const std::string&>();
    if (digits.size() <= 1000)
      if (const auto count = BigCount::FromDecimal(digits)) return *count;
  }
  reader.Fail(field, "must be a count");
  return 0;
}

Choice ReadRow(Reader row, const Problem& problem, optimizer::Configuration configuration) {
  Choice choice = ReadChoice(row, problem, configuration);
  choice.mass_kg = row.Number("mass_kg", kAnyNumber);
  choice.volume_m3 = M3FromL(row.Number("volume_l", kAnyNumber));
  choice.cost_eur = row.OptionalNumber("cost_eur", kAnyNumber);
  return choice;
}

void ReadPerformance(Reader performance, const Problem& problem, Design& design) {
  optimizer::Performance& given = design.performance;
  const std::size_t groups = problem.groups.size();
  for (const Element& element : performance.List("groups", groups, groups)) {
    Reader group(element, performance.errors());
    given.groups.push_back(
        {group.Number("rise_time_s", kAnyNumber), group.Number("fall_time_s", kAnyNumber),
         group.Number("inflate_time_s", kAnyNumber), group.Number("frequency_hz_max", kAnyNumber),
         optimizer::PaFromKpaGauge(problem, group.Number("peak_kpa_gauge", kAnyNumber))});
  }
  given.frequency_sustained_hz = performance.Number("frequency_hz_sustained", kAnyNumber);
  given.air_per_actuation_m3 = M3FromL(performance.Number("air_per_actuation_l_anr", kAnyNumber));
  given.air_total_m3 = M3FromL(performance.Number("air_total_l_anr", kAnyNumber));
  given.run_time_s = performance.Number("run_time_s", kAnyNumber);
}

double PriceOf(const std::vector<Choice>& parts) {
  double sum = 0.0;
  for (const Choice& part : parts) sum += part.cost_eur.value_or(0.0);
  return sum;
}

optimizer::PackRow ReadPack(Reader row, const Problem& problem,
                            optimizer::Configuration configuration) {
  const Choice choice = ReadChoice(row, problem, configuration);
  return {choice.family,
          choice.id,
          choice.quantity,
          row.Number("pack", kAnyNumber),
          row.Number("packs", kAnyNumber),
          row.Number("cost_eur", kAnyNumber)};
}

Design ReadDesign(const Element& element, int rank, const Problem& problem, Errors& errors) {
  Reader reader(element, errors);
  Design design;
  if (reader.Integer("rank", 1, 1'000'000) != rank)
    reader.Fail("rank", "must be " + std::to_string(rank) + ", the place in the list");
  design.configuration = ReadConfiguration(reader);
  design.objective = reader.Number("objective", kAnyNumber);
  for (const Element& row : reader.List("parts", 1, kDesignRowsMax))
    design.parts.push_back(ReadRow(Reader(row, errors), problem, design.configuration));
  if (reader.Has("packs"))  // answers of releases before do not state it
    for (const Element& row : reader.List("packs", 0, kDesignRowsMax))
      design.packs.push_back(ReadPack(Reader(row, errors), problem, design.configuration));
  AddOutside(problem, design);
  Reader settings = reader.Object("settings");
  design.settings = ReadPoint(settings, problem, design.configuration);
  if (optimizer::KeepsReservoir(design.configuration) && !design.settings.reservoir_volume_m3)
    settings.Fail("reservoir_volume_ml", "is missing: a pump's design has a reservoir");
  design.settings.compressor_duty = settings.OptionalNumber("compressor_duty", kAnyNumber);
  if (auto& rail = design.settings.rail) {
    rail->stop_pa =
        optimizer::PaFromKpaGauge(problem, settings.Number("vacuum_stop_kpa_gauge", kAnyNumber));
    rail->duty = settings.Number("vacuum_duty", kAnyNumber);
    rail->volume_m3 = M3FromMl(settings.Number("vacuum_reservoir_volume_ml", kAnyNumber));
  }
  design.settings.valve_duty = settings.Numbers("valve_duty_groups", kDesignRowsMax, kAnyNumber);
  if (design.settings.valve_duty.size() != problem.groups.size())
    settings.Fail("valve_duty_groups", "must have one number for each group");
  Reader totals = reader.Object("totals");
  design.totals.mass_kg = totals.Number("mass_kg", kAnyNumber);
  design.totals.volume_m3 = M3FromL(totals.Number("volume_l", kAnyNumber));
  design.totals.cost_eur = totals.OptionalNumber("cost_eur", kAnyNumber);
  design.totals.cost_known_eur =  // answers of releases before do not state it
      totals.OptionalNumber("cost_eur_min", kAnyNumber).value_or(PriceOf(design.parts));
  design.totals.energy_j = totals.Number("energy_wh", kAnyNumber) * kJPerWh;
  ReadPerformance(reader.Object("performance"), problem, design);
  for (const Element& row : reader.List("margins", 0, kDesignRowsMax)) {
    Reader margin(row, errors);
    design.margins.push_back({margin.Text("requirement"), margin.Number("required", kAnyNumber),
                              margin.Number("achieved", kAnyNumber),
                              margin.Number("relative_margin", kAnyNumber)});
  }
  return design;
}

optimizer::Proof ReadProof(Reader reader, const Problem& problem) {
  optimizer::Proof proof;
  proof.combinations = ReadCount(reader, "combinations");
  proof.complete = reader.Bool("complete", false);
  proof.lower_bound =
      reader.OptionalNumber("lower_bound", kAnyNumber).value_or(optimizer::kUnlimited);
  proof.gap = reader.Number("gap", {0, 1});
  proof.evaluated = ReadCount(reader, "evaluated");
  proof.undecided = reader.Integer("undecided", 0, 2'000'000'000);
  Reader pruned = reader.Object("pruned");
  proof.pruned = {ReadCount(pruned, "incompatible"), ReadCount(pruned, "infeasible"),
                  ReadCount(pruned, "bound"), ReadCount(pruned, "dominated"),
                  ReadCount(pruned, "unpriced")};
  if (auto record = reader.OptionalObject("record"))
    proof.record = std::make_shared<optimizer::ProofRecord>(ReadRecord(*record, problem.parts));
  return proof;
}

optimizer::Status ReadStatus(Reader& reader) {
  using optimizer::Status;
  return ReadEnum<Status>(
      reader, "status",
      {Status::kOptimal, Status::kFeasible, Status::kInfeasible, Status::kCancelled});
}

// How many of the draws a share stands for.
int ReadShare(Reader& reader, const char* field, int draws) {
  const double count = reader.OptionalNumber(field, kShare).value_or(0.0) * draws;
  return static_cast<int>(std::lround(std::isfinite(count) ? count : 0.0));
}

// Designs that are listed stand there with their place in the list alone.
optimizer::Searched ReadSearched(Reader reader, const Problem& problem,
                                 const optimizer::Answer& listed) {
  optimizer::Searched searched;
  searched.count = reader.Integer("count", problem.count, kDesignsMax);
  searched.answer.status = ReadStatus(reader);
  searched.answer.proof = listed.proof;
  searched.answer.proof.complete = searched.answer.status == optimizer::Status::kOptimal ||
                                   searched.answer.status == optimizer::Status::kInfeasible;
  searched.answer.proof.lower_bound =
      reader.OptionalNumber("lower_bound", kAnyNumber).value_or(optimizer::kUnlimited);
  searched.answer.proof.gap = reader.Number("gap", kShare);
  const int listed_count = static_cast<int>(listed.designs.size());
  for (const Element& element : reader.List("designs", 0, kDesignsMax)) {
    Reader design(element, reader.errors());
    const int rank = static_cast<int>(searched.place.size()) + 1;
    if (!design.Has("listed")) {
      searched.place.push_back(-1);
      searched.answer.designs.push_back(ReadDesign(element, rank, problem, reader.errors()));
      continue;
    }
    const int place = design.Integer("listed", 1, listed_count);
    searched.place.push_back(place - 1);
    searched.answer.designs.push_back(place <= listed_count ? listed.designs[place - 1] : Design{});
  }
  return searched;
}

// Everything that stands there follows from the request and the counts.
void CheckStated(Reader& reader, const RobustRequest& request,
                 const optimizer::RobustAnswer& robust) {
  using Unordered = nlohmann::json;
  Json again = {{"designs", Json(robust.robustness.size(), Json::object())}};
  AddRobustness(request, robust, again);
  Unordered stated = *reader.Raw("robust");
  stated.erase("searched");
  // Answers of releases that knew no measured numbers do not state their tolerance.
  if (const auto tolerance = stated.find("tolerance");
      tolerance != stated.end() && tolerance->is_object() && !tolerance->contains("measured"))
    (*tolerance)["measured"] = Tolerance{}.measured;
  if (stated != Unordered(again["robust"]))
    reader.Fail("robust", "is not what the request asks for: " + again["robust"].dump());
  for (std::size_t i = 0; i < robust.robustness.size(); ++i) {
    const Json& own = again["designs"][i]["robustness"];
    if (Unordered((*reader.Raw("designs"))[i]["robustness"]) != Unordered(own))
      reader.FailAt("designs/" + std::to_string(i) + "/robustness",
                    "its numbers do not fit each other");
  }
}

}  // namespace

optimizer::Answer ReadAnswer(Reader& reader, const Problem& problem) {
  optimizer::Answer answer;
  answer.status = ReadStatus(reader);
  answer.lower_bound_prices = problem.unpriced_allowed;
  for (const Element& design : reader.List("designs", 0, kDesignsMax))
    answer.designs.push_back(
        ReadDesign(design, static_cast<int>(answer.designs.size()) + 1, problem, reader.errors()));
  answer.proof = ReadProof(reader.Object("proof"), problem);
  return answer;
}

optimizer::Front ReadFront(Reader& reader, const std::vector<optimizer::Amount>& amounts,
                           optimizer::Answer answer) {
  optimizer::Front front;
  front.amounts = amounts;
  const std::size_t size = answer.designs.size();
  std::size_t rank = 0;
  for (const Element& element : reader.List("front", size, size)) {
    Reader point(element, reader.errors());
    const Design& design = answer.designs[rank++];
    if (point.Integer("rank", 1, 1'000'000) != static_cast<int>(rank))
      point.Fail("rank", "must be " + std::to_string(rank) + ", the place of its design");
    Reader objectives = point.Object("objectives");
    for (const optimizer::Amount amount : amounts) {
      const char* name = optimizer::Name(amount);
      if (!verify::Near(objectives.Number(name, kAnyNumber), Of(amount, design.totals),
                        verify::kSumTolerance))
        objectives.Fail(name, "is not the total of its design");
    }
  }
  Reader proof = reader.Object("front_proof");
  front.resolution = proof.Number("resolution", {0, 1});
  front.searches = static_cast<int>(proof.Integer("searches", 0, 2'000'000'000));
  front.proved = static_cast<int>(proof.Integer("proved", 0, 2'000'000'000));
  if (proof.Bool("complete", false) != answer.proof.complete)
    proof.Fail("complete", "is not that of the proof");
  front.unexplored.resize(proof.List("unexplored", 0, 2'000'000).size());
  front.answer = std::move(answer);
  return front;
}

optimizer::RobustAnswer ReadRobustAnswer(Reader& reader, const Problem& problem,
                                         const RobustRequest& request, optimizer::Answer answer) {
  optimizer::RobustAnswer robust;
  Reader stated = reader.Object("robust");
  robust.draws = stated.Integer("draws", 0, request.options.draws);
  robust.below = stated.Integer("left_out", 0, kDesignsMax);
  for (const Element& element : reader.List("designs", 0, kDesignsMax)) {
    Reader design(element, reader.errors());
    Reader robustness = design.Object("robustness");
    robust.robustness.push_back({ReadShare(robustness, "probability", robust.draws),
                                 ReadShare(robustness, "share_rank_1", robust.draws)});
  }
  if (request.options.probability_min)
    robust.searched = ReadSearched(stated.Object("searched"), problem, answer);
  robust.answer = std::move(answer);
  if (reader.errors().empty()) CheckStated(reader, request, robust);
  return robust;
}

}  // namespace plenum::api
