// Requirements by questions: each answer is checked at once, as part of a whole document.
#ifndef PLENUM_SERVER_COMMANDS_INIT_INTERVIEW_H_
#define PLENUM_SERVER_COMMANDS_INIT_INTERVIEW_H_

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "api/json/json.h"

namespace plenum::server {

// What is wrong with requirements, and the warnings about them as text.
struct Opinion {
  api::Errors errors;
  std::string warnings;
};

struct Interview {
  std::istream& answers;  // one a line; an empty line, or none left, keeps what stands there
  std::function<void(const std::string&)> say;
  // Whether a person answers, who is asked again after an answer that cannot be used; BadInput
  // otherwise.
  bool person;
  std::function<Opinion(const api::Json&)> judge;
};

// requirements/1 with a note in each object that says what may be changed there.
api::Json AskRequirements(Interview& interview);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_COMMANDS_INIT_INTERVIEW_H_
