#include "server/call/service_limits.h"

#include "api/json/problem_document.h"
#include "api/json/render_limits.h"

namespace plenum::server {

api::Json RenderLimits(const JobQuota& jobs, const catalog::JobsKept& kept) {
  api::Json limits = {{"head_bytes_max", kHeadBytesMax},
                      {"headers_max", kHeadersMax},
                      {"path_bytes_max", kPathBytesMax},
                      {"head_seconds_max", kHeadSecondsMax},
                      {"idle_seconds_max", kIdleSecondsMax},
                      {"body_bytes_max", kBodyBytesMax},
                      {"body_bytes_per_second_min", kBytesPerSecondMin},
                      {"answer_bytes_per_second_min", kAnswerBytesPerSecondMin},
                      {"buffered_bytes_max", kBufferedBytesMax},
                      {"answer_bytes_max", kAnswerBytesMax},
                      {"large_body_bytes", kLargeBodyBytes},
                      {"large_page_parts", kLargePageParts},
                      {"large_requests_max", kLargeMax},
                      {"large_requests_waiting_max", kLargeWaitingMax},
                      {"large_requests_wait_seconds", kLargeWaitSeconds},
                      {"import_bytes_max", kImportBytesMax},
                      {"document_bytes_max", kDocumentBytesMax},
                      {"large_imports_max", kLargeImportsMax},
                      {"import_rows_max", kImportRowsMax},
                      {"import_columns_max", catalog::kCsvColumnsMax},
                      {"import_cell_bytes_max", catalog::kCsvCellBytesMax},
                      {"catalogue_waiting_max", kCatalogueWaitingMax},
                      {"catalogue_wait_seconds", kCatalogueWaitSeconds},
                      {"connections_max", kConnectionsMax},
                      {"requests_at_a_time_max", kRequestThreads},
                      {"computing_max", kComputingMax},
                      {"large_computing_max", kLargeComputingMax},
                      {"sweeps_read_max", kSweepsReadMax},
                      {"waiting_max", kWaitingMax},
                      {"wait_seconds_max", kWaitSecondsMax},
                      {"event_streams_max", kStreamsMax},
                      {"job_memory_bytes_max", kJobMemoryBytesMax},
                      {"large_diagnosis_samples", kLargeDiagnosisSamples},
                      {"large_diagnoses_running_max", kLargeDiagnosesMax},
                      {"jobs_running_max", jobs.running_max},
                      {"jobs_queued_max", jobs.queued_max},
                      {"jobs_queued_per_client_max", jobs.queued_per_client_max},
                      {"sweep_jobs_queued_max", jobs.swept_queued_max},
                      {"sweep_jobs_queued_per_client_max", jobs.swept_queued_per_client_max},
                      {"jobs_kept_max", kept.jobs},
                      {"jobs_kept_bytes_max", kept.bytes}};
  limits.update(api::RenderRequestLimits());
  return limits;
}

Reply LimitReply(int status, const std::string& name, const api::Json& value,
                 const std::string& detail) {
  api::Json document = api::ProblemDocument(status, detail);
  document["limit"] = {{"name", name}, {"value", value}};
  return {status, "application/problem+json", Dump(document) + "\n", {}, {}};
}

std::shared_ptr<void> Gate::Enter(Ticket& ticket) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [](const auto& one) { return one.expired(); });
  const bool first = waiting_.empty() || (ticket && waiting_.front().lock() == ticket);
  if (free_ > 0 && first) {
    if (!waiting_.empty()) waiting_.pop_front();
    ticket = nullptr;
    --free_;
    return {this, [](Gate* gate) { gate->Leave(); }};
  }
  if (!ticket && waiting_.size() < waiting_max_) {
    ticket = std::make_shared<const int>(0);
    waiting_.emplace_back(ticket);
  }
  return nullptr;
}

void Gate::Leave() {
  {
    const std::lock_guard lock(mutex_);
    ++free_;
  }
  on_leave_();
}

Bytes ByteBudget::Hold(std::string text) {
  const std::size_t size = text.size();
  std::size_t held = *held_;
  do {
    if (held > 0 && held + size > max_) return nullptr;
  } while (!held_->compare_exchange_weak(held, held + size));
  const std::shared_ptr<const void> counted(nullptr,
                                            [all = held_, size](const void*) { *all -= size; });
  struct Counted {
    std::shared_ptr<const void> place;
    std::string text;
  };
  const auto kept = std::make_shared<const Counted>(Counted{counted, std::move(text)});
  return {kept, &kept->text};
}

Reply BusyReply(const std::string& name, const api::Json& value, const std::string& detail,
                int retry_after_s) {
  Reply reply = LimitReply(429, name, value, detail);
  reply.headers.emplace_back("Retry-After", std::to_string(retry_after_s));
  return reply;
}

}  // namespace plenum::server
