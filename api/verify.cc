#include "api/verify.h"

#include <map>

#include "api/design_reader.h"
#include "api/proof_record.h"
#include "api/text.h"
#include "api/units.h"
#include "optimizer/pareto.h"
#include "optimizer/verify.h"

namespace plenum::api {
namespace {

using optimizer::BigCount;
using optimizer::Choice;
using optimizer::Design;
using optimizer::Problem;

const Range kAnyNumber{-1e300, 1e300};
constexpr std::size_t kDesignsMax = 500;

// A decimal string, or a number up to 2⁵³.
BigCount ReadCount(Reader& reader, const char* field) {
  const Json* value = reader.Raw(field);
  if (value != nullptr && value->is_number_integer() && *value >= 0)
    return value->get<std::int64_t>();
  if (value != nullptr && value->is_string()) {
    const std::string& digits = value->get_ref<const std::string&>();
    if (!digits.empty() && digits.size() <= 1000 &&
        digits.find_first_not_of("0123456789") == std::string::npos)
      return BigCount(digits.substr(std::min(digits.find_first_not_of('0'), digits.size() - 1)));
  }
  reader.Fail(field, "must be a count");
  return 0;
}

Choice ReadRow(Reader row, const Problem& problem) {
  Choice choice = ReadChoice(row, problem);
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
         group.Number("inflate_time_s", kAnyNumber), group.Number("frequency_hz_max", kAnyNumber)});
  }
  given.frequency_sustained_hz = performance.Number("frequency_hz_sustained", kAnyNumber);
  given.air_per_actuation_m3 = M3FromL(performance.Number("air_per_actuation_l_anr", kAnyNumber));
  given.air_total_m3 = M3FromL(performance.Number("air_total_l_anr", kAnyNumber));
  given.run_time_s = performance.Number("run_time_s", kAnyNumber);
}

Design ReadDesign(const Element& element, int rank, const Problem& problem, Errors& errors) {
  Reader reader(element, errors);
  Design design;
  if (reader.Integer("rank", 1, 1'000'000) != rank)
    reader.Fail("rank", "must be " + std::to_string(rank) + ", the place in the list");
  design.configuration = ReadConfiguration(reader);
  design.objective = reader.Number("objective", kAnyNumber);
  for (const Element& row : reader.List("parts", 1, kDesignRowsMax))
    design.parts.push_back(ReadRow(Reader(row, errors), problem));
  Reader settings = reader.Object("settings");
  design.settings = ReadPoint(settings, problem);
  design.settings.compressor_duty = settings.OptionalNumber("compressor_duty", kAnyNumber);
  design.settings.valve_duty = settings.Numbers("valve_duty_groups", kDesignRowsMax, kAnyNumber);
  if (design.settings.valve_duty.size() != problem.groups.size())
    settings.Fail("valve_duty_groups", "must have one number for each group");
  Reader totals = reader.Object("totals");
  design.totals.mass_kg = totals.Number("mass_kg", kAnyNumber);
  design.totals.volume_m3 = M3FromL(totals.Number("volume_l", kAnyNumber));
  design.totals.cost_eur = totals.OptionalNumber("cost_eur", kAnyNumber);
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

optimizer::Answer ReadAnswer(Reader& reader, const Problem& problem) {
  optimizer::Answer answer;
  using optimizer::Status;
  answer.status = ReadEnum<Status>(
      reader, "status",
      {Status::kOptimal, Status::kFeasible, Status::kInfeasible, Status::kCancelled});
  for (const Element& design : reader.List("designs", 0, kDesignsMax))
    answer.designs.push_back(
        ReadDesign(design, static_cast<int>(answer.designs.size()) + 1, problem, reader.errors()));
  answer.proof = ReadProof(reader.Object("proof"), problem);
  return answer;
}

// The point of each design is that of its totals, and is left at that.
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
      if (!optimizer::Near(objectives.Number(name, kAnyNumber), Of(amount, design.totals),
                           optimizer::kSumTolerance))
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

std::string RevisionName(const Json& number, const std::string& hash) {
  return "revision " + number.dump() + " (" + Clip(hash, 12) + ")";
}

// What the result was computed from is what is on the table.
Json CheckCatalogue(Reader& reader, const catalog::Revision& revision) {
  Reader named = reader.Object("catalogue_revision");
  const Json* number = named.Raw("number");
  const std::string hash = named.Text("hash");
  const bool same = hash == revision.hash;
  return {{"check", "catalogue"},
          {"ok", same},
          {"detail", same ? "the result was computed from these parts"
                          : "the result was computed from " +
                                RevisionName(number ? *number : Json(nullptr), hash) +
                                ", the catalogue is at " +
                                RevisionName(revision.number, revision.hash)}};
}

Json Refused(const std::string& check, const std::string& detail) {
  return {{"check", check}, {"ok", false}, {"detail", detail}};
}

Json RenderCounts(const optimizer::BruteForceCounts& counts) {
  return {{"cancelled", counts.cancelled},
          {"combinations", counts.combinations.str()},
          {"incompatible", counts.incompatible.str()},
          {"unpriced", counts.unpriced.str()},
          {"beyond_the_list", counts.beyond.str()},
          {"infeasible", counts.infeasible.str()},
          {"feasible", counts.feasible.str()},
          {"undecided", counts.undecided.str()}};
}

optimizer::Verification VerifyList(const Problem& problem, const optimizer::Answer& answer,
                                   const std::optional<BruteForce>& brute_force) {
  optimizer::BruteForceOptions options;
  if (brute_force) {
    const double all = optimizer::CombinationsOf(problem).convert_to<double>();
    options.cancelled = brute_force->cancelled;
    if (brute_force->progress)
      options.progress = [&brute_force, all](const BigCount& looked) {
        brute_force->progress(looked.convert_to<double>() / all);
      };
  }
  return optimizer::Verify(problem, answer, brute_force ? &options : nullptr);
}

// Adds checks, what they left open and counts to the document.
void AddVerification(const optimizer::Verification& verification, Json& document) {
  for (const optimizer::Check& check : verification.checks)
    document["checks"].push_back(
        {{"check", check.name}, {"ok", check.ok}, {"detail", check.detail}});
  for (const optimizer::NotRechecked& open : verification.not_rechecked)
    document["not_rechecked"].push_back(
        {{"what", open.what}, {"combinations", open.combinations.str()}});
  if (verification.brute_force) document["brute_force"] = RenderCounts(*verification.brute_force);
}

}  // namespace

Parsed<Json> VerifyAnswer(const Json& result, const std::vector<catalog::Part>& parts,
                          const catalog::Revision& revision,
                          const std::optional<BruteForce>& brute_force) {
  Errors errors;
  Reader reader(result, "", errors);
  reader.Schema("designs/1");
  Json document = {{"schema", "verification/1"}, {"accepted", false}};
  document["checks"] = Json::array({CheckCatalogue(reader, revision)});
  document["not_rechecked"] = Json::array();
  const Json* request = reader.Raw("requirements");
  if (request == nullptr) reader.Fail("requirements", "is required, the request as it was given");
  if (reader.Has("robust"))
    reader.Fail("robust", "only a list or a front without draws can be verified");
  if (!errors.empty()) return errors;
  if (document["checks"][0]["ok"].get<bool>()) {
    if (request->is_object() && request->value("model", Json("nominal")) != "nominal")
      return Errors{{"/requirements/model", "only answers of the nominal model can be verified"}};
    auto parsed = ParseRequirements(*request, parts);
    if (auto* wrong = std::get_if<Errors>(&parsed)) {
      for (Error& error : *wrong) error.pointer.insert(0, "/requirements");
      return *wrong;
    }
    const DesignRequest& asked = std::get<DesignRequest>(parsed);
    const Problem& problem = asked.problem;
    if (reader.Has("front") == asked.pareto.empty())
      return Errors{{"/front", "must be there where a front was asked for, and only there"}};
    if (brute_force && !asked.pareto.empty())
      return Errors{{"/front", "only a list by one objective can be verified by brute force"}};
    const BigCount combinations = optimizer::CombinationsOf(problem);
    if (brute_force && combinations > brute_force->combinations_max)
      return Errors{{"/proof/combinations", "brute force would look at " + combinations.str() +
                                                " combinations, the limit is " +
                                                std::to_string(brute_force->combinations_max) +
                                                " (--combinations-max raises it)"}};
    optimizer::Answer answer = ReadAnswer(reader, problem);
    if (!asked.pareto.empty()) {
      const optimizer::Front front = ReadFront(reader, asked.pareto, std::move(answer));
      if (errors.empty()) AddVerification(optimizer::VerifyFront(problem, front), document);
    } else if (errors.empty()) {
      AddVerification(VerifyList(problem, answer, brute_force), document);
    }
    if (!errors.empty())
      for (const Error& error : errors)
        document["checks"].push_back(Refused("form", error.pointer + ": " + error.detail));
  }
  bool accepted = !document.value("/brute_force/cancelled"_json_pointer, false);
  for (const Json& check : document["checks"]) accepted = accepted && check["ok"].get<bool>();
  document["accepted"] = accepted;
  return document;
}

}  // namespace plenum::api
