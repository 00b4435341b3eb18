#include "api/json/problem_document.h"

#include <algorithm>

#include "api/json/request_limits.h"

namespace plenum::api {
namespace {

const char* Title(int status) {
  switch (status) {
    case 400:
      return "Bad Request";
    case 401:
      return "Unauthorized";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 409:
      return "Conflict";
    case 412:
      return "Precondition Failed";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 422:
      return "Unprocessable Content";
    case 428:
      return "Precondition Required";
    case 429:
      return "Too Many Requests";
    case 431:
      return "Request Header Fields Too Large";
    case 500:
      return "Internal Server Error";
    case 501:
      return "Not Implemented";
    case 503:
      return "Service Unavailable";
    case 505:
      return "HTTP Version Not Supported";
    case 507:
      return "Insufficient Storage";
    default:
      return status < 500 ? "Request refused" : "Fault of the service";
  }
}

Json Document(int status) {
  return {{"type", "about:blank"}, {"title", Title(status)}, {"status", status}};
}

}  // namespace

Json ProblemDocument(int status, const Errors& errors) {
  Json document = Document(status);
  if (errors.empty()) return document;
  Json& list = document["errors"] = Json::array();
  for (std::size_t i = 0; i < std::min(errors.size(), kErrorsReportedMax); ++i)
    list.push_back({{"pointer", errors[i].pointer}, {"detail", errors[i].detail}});
  if (errors.size() > kErrorsReportedMax)
    list.push_back(
        {{"pointer", ""},
         {"detail", std::to_string(errors.size() - kErrorsReportedMax) + " more errors"}});
  return document;
}

Json ProblemDocument(int status, const std::string& detail) {
  Json document = Document(status);
  document["detail"] = detail;
  return document;
}

std::string Lines(const Errors& errors) {
  std::string lines;
  for (const Error& error : errors)
    lines += (error.pointer.empty() ? "" : error.pointer + ": ") + error.detail + "\n";
  return lines;
}

}  // namespace plenum::api
