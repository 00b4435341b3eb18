// What each operation of the service takes and answers, beyond what its route says.
#ifndef PLENUM_SERVER_RESOURCES_SCHEMAS_OPERATIONS_H_
#define PLENUM_SERVER_RESOURCES_SCHEMAS_OPERATIONS_H_

#include <string>
#include <vector>

namespace plenum::server {

struct Operation {
  std::vector<std::string> parameters = {};  // names in the components
  std::string body = {};  // schema of the request; "csv": rows of parts, "file": of a document
  struct Answer {
    int status;
    std::string schema;  // in the components; empty: no body
    const char* media = "application/json";
  };
  std::vector<Answer> answers = {};
  std::vector<int> problems = {};
};

// Throws where the operation is not described.
const Operation& OperationOf(const std::string& method, const std::string& path);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SCHEMAS_OPERATIONS_H_
