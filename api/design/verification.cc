#include "api/design/verification.h"

#include <cmath>

#include "api/design/guaranteed.h"
#include "api/design/read/answer_reader.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/read/selection.h"
#include "api/json/remarks.h"
#include "api/json/version.h"
#include "api/json/words.h"
#include "verify/verify_draws.h"
#include "verify/verify_worlds.h"

namespace plenum::api {
namespace {

using optimizer::BigCount;
using optimizer::Problem;

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

Json RenderCounts(const verify::BruteForceCounts& counts) {
  return {{"cancelled", counts.cancelled},
          {"combinations", counts.combinations.str()},
          {"incompatible", counts.incompatible.str()},
          {"unpriced", counts.unpriced.str()},
          {"beyond_the_list", counts.beyond.str()},
          {"infeasible", counts.infeasible.str()},
          {"feasible", counts.feasible.str()},
          {"undecided", counts.undecided.str()}};
}

verify::Verification VerifyList(const Problem& problem, const optimizer::Answer& answer,
                                const std::optional<BruteForce>& brute_force,
                                const verify::Stop& stop) {
  verify::VerifyOptions options{stop, brute_force.has_value(), {}};
  if (brute_force && brute_force->progress)
    options.progress = [&brute_force,
                        all = verify::CombinationsOf(problem).ToDouble()](const BigCount& looked) {
      brute_force->progress(looked.ToDouble() / all);
    };
  return verify::Verify(problem, answer, options);
}

// Adds checks, what they left open and counts to the document.
void AddVerification(const verify::Verification& verification, Json& document) {
  for (const verify::Check& check : verification.checks)
    document["checks"].push_back(
        {{"check", check.name}, {"ok", check.ok}, {"detail", check.detail}});
  for (const verify::NotRechecked& open : verification.not_rechecked)
    document["not_rechecked"].push_back(
        {{"what", open.what}, {"combinations", open.combinations.str()}});
  if (verification.brute_force) document["brute_force"] = RenderCounts(*verification.brute_force);
}

// The problem as the answer's list has it.
Problem AsListed(Problem problem, Reader& reader) {
  const Json* list = reader.Raw("list");  // answers of releases without kinds do not state it
  problem.list = list && *list == optimizer::Name(optimizer::ListOf::kKinds)
                     ? optimizer::ListOf::kKinds
                     : optimizer::ListOf::kCombinations;
  const Json* prices = reader.Raw("price_basis");
  problem.unpriced_allowed = false;
  if (prices && *prices == "lower_bound") optimizer::AllowUnpriced(problem);
  return problem;
}

// What the answer says of both lists together must follow from them.
void CheckStated(Reader& reader, const GuaranteeRequest& asked, const Problem& guaranteed,
                 const optimizer::Answer& certain, const optimizer::Answer& on_paper) {
  constexpr double kRounding = 1e-8;  // of a difference of printed numbers
  const Json& stated = *reader.Raw("guarantee");
  const Json follows = RenderGuarantee(asked.tolerance, certain, on_paper);
  for (const auto& [field, value] : follows.items()) {
    const Json given = stated.is_object() ? stated.value(field, Json("nothing")) : Json();
    const bool same = value.is_number() && given.is_number()
                          ? std::abs(value.get<double>() - given.get<double>()) <= kRounding
                          : nlohmann::json(value) == nlohmann::json(given);
    if (!same) reader.FailAt("guarantee/" + field, "does not follow from the two lists");
  }
  for (std::size_t i = 0; i < certain.designs.size(); ++i) {
    const Json most = RenderMost(certain.designs[i], guaranteed);
    const Json said = (*reader.Raw("designs"))[i].value("guarantee", Json());
    for (const char* field : {"mass_kg_max", "volume_l_max"})
      if (!said.is_object() || !said.value(field, Json()).is_number() ||
          !verify::Near(said[field], most.at(field), verify::kSumTolerance))
        reader.FailAt("designs/" + std::to_string(i) + "/guarantee",
                      std::string(field) + " is not what its parts may come to");
  }
}

// Both lists with their records, the guaranteed designs in corners of the tolerances, and what is
// said of the two.
void VerifyGuaranteed(const DesignRequest& asked, Reader& reader,
                      const std::vector<catalog::Part>& rows,
                      const std::optional<BruteForce>& brute_force, const verify::Stop& stop,
                      Json& document) {
  constexpr int kWorlds = 8;
  if (!reader.Has("guarantee")) reader.Fail("guarantee", "must be there where it was asked for");
  Reader paper = reader.Object("on_paper");
  const Problem nominal = AsListed(asked.problem, paper);
  const Problem worst = AsListed(GuaranteedProblem(asked.problem, *asked.guarantee, rows), reader);
  const optimizer::Answer certain = ReadAnswer(reader, worst);
  const optimizer::Answer on_paper = ReadAnswer(paper, nominal);
  if (!reader.errors().empty()) return;
  CheckStated(reader, *asked.guarantee, worst, certain, on_paper);
  AddVerification(VerifyList(worst, certain, brute_force, stop), document);
  const Tolerance tolerance = asked.guarantee->tolerance;
  AddVerification(verify::VerifyWorlds(nominal, certain.designs, kWorlds,
                                       MakeDraws(rows, nominal,
                                                 [tolerance](catalog::Part row, int corner) {
                                                   return row.id == kCustomReservoir
                                                              ? row
                                                              : AtCorner(std::move(row), tolerance,
                                                                         corner);
                                                 }),
                                       stop),
                  document);
  verify::Verification of_paper = VerifyList(nominal, on_paper, brute_force, stop);
  for (verify::Check& check : of_paper.checks) check.name = "on_paper." + check.name;
  of_paper.brute_force.reset();
  AddVerification(of_paper, document);
  document["not_rechecked"].push_back(
      {{"what", "measure_first: each saving is that of a search"}, {"combinations", "0"}});
}

// The front or the list; where draws were asked for, them, too. A list that asks for a probability
// stands or falls with the one that it was chosen from.
void VerifyAsked(const DesignRequest& asked, Reader& reader,
                 const std::vector<catalog::Part>& parts,
                 const std::optional<BruteForce>& brute_force, const verify::Stop& stop,
                 Json& document) {
  if (asked.guarantee) return VerifyGuaranteed(asked, reader, parts, brute_force, stop, document);
  const Problem problem = AsListed(asked.problem, reader);
  optimizer::RobustAnswer robust;
  robust.answer = ReadAnswer(reader, problem);
  if (asked.robust && reader.errors().empty())
    robust = ReadRobustAnswer(reader, problem, *asked.robust, std::move(robust.answer));
  std::optional<optimizer::Front> front;
  if (!asked.pareto.empty() && reader.errors().empty())
    front = ReadFront(reader, asked.pareto, robust.answer);
  if (!reader.errors().empty()) return;
  if (front) {
    AddVerification(verify::VerifyFront(problem, *front, stop), document);
  } else if (robust.searched) {
    Problem deeper = problem;
    deeper.count = robust.searched->count;
    AddVerification(VerifyList(deeper, robust.searched->answer, brute_force, stop), document);
  } else {
    AddVerification(VerifyList(problem, robust.answer, brute_force, stop), document);
  }
  if (asked.robust)
    AddVerification(verify::VerifyDraws(problem, robust, asked.robust->options,
                                        MakeDraws(parts, problem, asked.robust->tolerance,
                                                  static_cast<std::uint64_t>(asked.robust->seed)),
                                        stop),
                    document);
}

}  // namespace

Parsed<Json> VerifyAnswer(const Json& result, const std::vector<catalog::Part>& parts,
                          const catalog::Revision& revision,
                          const std::optional<BruteForce>& brute_force,
                          const std::function<bool()>& stop) {
  bool stopped = false;  // some check was told to stop
  const verify::Stop stop_once = [&] { return stopped = stopped || (stop && stop()); };
  Errors errors;
  Reader reader(result, "", errors);
  reader.Schema("designs/1");
  Json document = AnswerDocument("verification/1");
  document["accepted"] = false;
  document["checks"] = Json::array({CheckCatalogue(reader, revision)});
  document["not_rechecked"] = Json::array();
  const Json* request = reader.Raw("requirements");
  if (request == nullptr) reader.Fail("requirements", "is required, the request as it was given");
  if (!errors.empty()) return errors;
  if (document["checks"][0]["ok"].get<bool>()) {
    if (request->is_object() && request->value("model", Json("nominal")) != "nominal")
      return Errors{{"/requirements/model", "only answers of the nominal model can be verified"}};
    auto parsed = ParseRequirements(*request, parts);
    if (auto* wrong = std::get_if<Errors>(&parsed)) {
      PutUnder("/requirements", *wrong);
      return *wrong;
    }
    const DesignRequest& asked = std::get<DesignRequest>(parsed);
    const Problem& problem = asked.problem;
    if (reader.Has("robust") != asked.robust.has_value())
      return Errors{{"/robust", "must be there where draws were asked for, and only there"}};
    if (asked.robust && asked.robust->options.probability_min && !asked.proof)
      return Errors{{"/requirements/ranking/proof",
                     "must be true: a list that asks for a probability is verified with the record "
                     "of its search"}};
    if (reader.Has("front") == asked.pareto.empty())
      return Errors{{"/front", "must be there where a front was asked for, and only there"}};
    if (brute_force && !asked.pareto.empty())
      return Errors{{"/front", "only a list by one objective can be verified by brute force"}};
    const BigCount combinations = verify::CombinationsOf(problem);
    if (brute_force && combinations > brute_force->combinations_max)
      return Errors{{"/proof/combinations", "brute force would look at " + combinations.str() +
                                                " combinations, the limit is " +
                                                std::to_string(brute_force->combinations_max) +
                                                " (--combinations-max raises it)"}};
    VerifyAsked(asked, reader, parts, brute_force, stop_once, document);
    if (!errors.empty())
      for (const Error& error : errors)
        document["checks"].push_back(Refused("form", error.pointer + ": " + error.detail));
  }
  bool accepted = !stopped;
  for (const Json& check : document["checks"]) accepted = accepted && check["ok"].get<bool>();
  document["accepted"] = accepted;
  document["stopped"] = stopped;
  return document;
}

}  // namespace plenum::api
