// Text to documents of the contract and back; what is wrong with them as an exception.
#ifndef PLENUM_PYTHON_CORE_DOCUMENTS_H_
#define PLENUM_PYTHON_CORE_DOCUMENTS_H_

#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "api/json/json.h"

namespace plenum::python {

// Becomes plenum.InputError.
class Refused : public std::runtime_error {
 public:
  explicit Refused(api::Errors errors);
  const api::Errors& errors() const { return errors_; }

 private:
  api::Errors errors_;
};

api::Json Parse(const std::string& text);
std::string Dump(const api::Json& json);

template <typename T>
T ValueOrRefuse(api::Parsed<T> parsed) {
  if (auto* errors = std::get_if<api::Errors>(&parsed)) throw Refused(std::move(*errors));
  return std::get<T>(std::move(parsed));
}

}  // namespace plenum::python

#endif  // PLENUM_PYTHON_CORE_DOCUMENTS_H_
