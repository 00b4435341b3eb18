#include "server/resources/designs_resource.h"

#include <charconv>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/given/unit_of_design.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/sweep/sweep_table.h"
#include "api/json/json.h"
#include "api/measure/model_document.h"
#include "server/call/signature.h"
#include "server/jobs/job_inputs.h"

namespace plenum::server {
namespace {

// What a list of jobs shows of the requirements: what `best` and `lower_bound` of a progress are
// amounts of, as it was written, and the note on the whole.
api::Json AskedOf(const api::Json& requirements) {
  api::Json asked = {
      {"objective", requirements.value("objective", api::Json{{"minimize", "mass_kg"}})}};
  if (requirements.contains("note")) asked["note"] = requirements.at("note");
  return asked;
}

api::Json ToJson(const optimizer::Progress& progress, const api::Json& asked) {
  api::Json json = {{"seconds", api::Number(progress.seconds)},
                    {"evaluated", progress.evaluated},
                    {"open", progress.open},
                    {"best", progress.best ? api::Number(*progress.best) : api::Json()},
                    {"lower_bound", api::Number(progress.lower_bound)}};
  json.update(asked);
  if (progress.infeasible) json["status"] = "infeasible";
  return json;
}

// The last progress, which a list of jobs shows in place of the answer.
// Of a job of a sweep it holds the row of its table, too.
api::Json Outcome(const api::Json& answer, const api::Json& asked, bool of_sweep) {
  const api::Json& designs = answer.at("designs");
  api::Json outcome = {{"seconds", answer.at("seconds")},
                       {"evaluated", answer.at("proof").at("evaluated")},
                       {"best", designs.empty() ? api::Json() : designs.front().at("objective")},
                       {"lower_bound", answer.at("proof").at("lower_bound")},
                       {"outcome", answer.at("status")}};
  outcome.update(asked);
  if (of_sweep) outcome["row"] = api::SweepRow(answer);
  return outcome;
}

// As a search that its time limit ended: the list is what it had, with its gap.
void EndedByMemory(api::Json& answer) {
  if (answer.at("status") != "cancelled") return;
  answer["status"] = "feasible";
  answer["warnings"].push_back(
      {{"pointer", ""},
       {"detail",
        "the search took as much memory as the service has for searches (job_memory_bytes_max) and "
        "ended before its time limit; gap says how far it is from a proof"}});
}

}  // namespace

Work DesignWork(SharedCatalog& catalog, JobMemory& memory) {
  return [&catalog, &memory](const catalog::JobOrder& order,
                             const JobControl& control) -> api::Parsed<api::Json> {
    auto view = PartsOf(catalog, order);
    if (auto* errors = std::get_if<api::Errors>(&view)) return *errors;
    auto models = ModelsOf(catalog, order);
    if (auto* errors = std::get_if<api::Errors>(&models)) return *errors;
    auto json = api::ParseJson(order.request);
    if (auto* errors = std::get_if<api::Errors>(&json)) return *errors;
    const CatalogView& parts = std::get<CatalogView>(view);
    auto request = api::ParseRequirements(std::get<api::Json>(json), *parts.parts(),
                                          std::get<std::vector<catalog::ModelRevision>>(models));
    if (auto* errors = std::get_if<api::Errors>(&request)) return *errors;

    const api::Json asked = AskedOf(std::get<api::Json>(json));
    optimizer::SearchOptions options;
    const auto share = memory.Enter();
    options.cancelled = [&] { return share->must_end() || control.cancelled(); };
    options.progress = [&](const optimizer::Progress& progress) {
      share->Report(progress.open);
      control.report(ToJson(progress, asked));
    };
    api::Json answer =
        api::AnswerRequest(std::get<api::DesignRequest>(request), options, *parts.parts());
    if (share->must_end() && !control.cancelled()) EndedByMemory(answer);
    answer["catalogue_revision"] = api::RenderRevisionName(parts.revision);
    control.report(Outcome(answer, asked, !order.sweep.empty()));
    return answer;
  };
}

Reply PostDesign(SharedCatalog& catalog, const JobsResource& designs, const Call& call) {
  auto query_errors = CheckQuery(call, {"validate_only", "priority"});
  const bool validate_only = ReadFlag(call, "validate_only", query_errors);
  const int priority = ReadPriority(call, query_errors);
  if (!query_errors.empty()) return ProblemReply(422, query_errors);
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  const CatalogView view = catalog.View();
  auto parsed = api::ParseRequirements(std::get<api::Json>(json), *view.parts(), catalog.Models());
  if (auto* errors = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *errors);
  if (validate_only) {
    api::Json valid = {{"valid", true}};
    std::get<api::DesignRequest>(parsed).remarks.AddTo(valid);
    return JsonReply(200, valid);
  }
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  const auto& request = std::get<api::DesignRequest>(parsed);
  auto order = OrderOf(call, std::get<catalog::Signature>(signature), request.name, view.revision,
                       request.model);
  order.priority = priority;
  return StartJob(designs, call, std::move(order));
}

Reply UnitReply(const std::string& unit) {
  return {200,
          "application/octet-stream",
          unit,
          {{"Content-Disposition", "attachment; filename=\"supply.fmu\""}},
          {}};
}

Reply GetUnit(SharedCatalog& catalog, const JobsResource& designs, const Call& call) {
  const std::string id = call.argument.substr(0, call.argument.find('/'));
  const std::string_view text = std::string_view(call.argument).substr(id.size() + 1);
  int rank = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rank);
  const std::optional<Job> job = designs.jobs->Get(id);
  if (!job) return ProblemReply(404, "no design job has the id " + id);
  if (error != std::errc() || end != text.data() + text.size())
    return ProblemReply(404, "the rank of a design is a whole number from 1 on");
  if (!job->result) return ProblemReply(409, "the job " + id + " has no answer yet");
  const auto evaluation = api::EvaluationOfRank(api::Json::parse(*job->result), rank);
  if (const auto* errors = std::get_if<api::Errors>(&evaluation))
    return ProblemReply(404, "the answer " + errors->front().detail);
  const auto view = catalog.ViewAt(job->catalogue.number);
  if (!view || view->revision.hash != job->catalogue.hash)
    return ProblemReply(409, "the catalogue no longer holds the revision that the job was done on");
  const auto unit =
      api::MakeUnitFile(std::get<api::Json>(evaluation), *view->parts(), catalog.Models());
  if (const auto* errors = std::get_if<api::Errors>(&unit)) return ProblemReply(422, *errors);
  return UnitReply(std::get<std::string>(unit));
}

}  // namespace plenum::server
