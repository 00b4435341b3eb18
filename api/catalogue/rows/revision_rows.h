// The parts of one revision in order of id. A list that differs from another one by a few parts
// shares all other parts with it: a write to a catalogue of 200,000 parts costs two copied arrays,
// not 200,000 copied parts.
#ifndef PLENUM_API_CATALOGUE_ROWS_REVISION_ROWS_H_
#define PLENUM_API_CATALOGUE_ROWS_REVISION_ROWS_H_

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "api/catalogue/part_search.h"
#include "catalog/fields/part.h"
#include "catalog/store/revision.h"

namespace plenum::api {

using PartVector = std::shared_ptr<const std::vector<catalog::Part>>;

// How a list comes of another one: `count` of its rows from `from` on, then `part`, if any.
struct Run {
  std::size_t from = 0, count = 0;
  const catalog::Part* part = nullptr;
};

// The same for any array that has one value a row; `value_of` gives that of a part of a run.
template <typename T, typename ValueOf>
std::vector<T> Splice(const std::vector<T>& before, const std::vector<Run>& runs,
                      ValueOf value_of) {
  std::vector<T> after;
  after.reserve(before.size() + runs.size());
  for (const Run& run : runs) {
    const auto first = before.begin() + static_cast<std::ptrdiff_t>(run.from);
    after.insert(after.end(), first, first + static_cast<std::ptrdiff_t>(run.count));
    if (run.part != nullptr) after.push_back(value_of(*run.part));
  }
  return after;
}

class PartRows {
 public:
  static constexpr std::uint32_t kChanged = UINT32_MAX;

  explicit PartRows(PartVector parts);
  // The parts of `before` with `changes`; `runs` says how its rows become these.
  PartRows(const PartRows& before, catalog::PartChanges changes, std::vector<Run>& runs);

  std::size_t size() const { return rows_.size(); }
  const catalog::Part& operator[](std::size_t row) const { return *rows_[row]; }
  std::span<const catalog::Part* const> rows() const { return rows_; }
  // nullptr where none has the id.
  const catalog::Part* Find(std::string_view id) const;
  // The same parts in one vector, which is made when it is first asked for.
  PartVector All() const;
  // How many changes lie between the vector that this list began with and this list.
  std::size_t changes() const { return changes_; }

  // How well each part matches a text (part_search.h). The index over the parts that the list
  // began with is made once for all lists that came of it.
  std::vector<std::uint8_t> Search(std::string_view text) const;

 private:
  struct Base {
    explicit Base(PartVector all) : parts(std::move(all)) {}
    const PartVector parts;
    std::once_flag search_made;
    std::unique_ptr<const PartSearch> search;
  };

  std::size_t LowerBound(std::string_view id, std::size_t from) const;

  std::shared_ptr<Base> base_;
  std::vector<std::shared_ptr<const catalog::Part>> added_;  // since then, also those that went
  std::size_t changes_ = 0;
  std::vector<const catalog::Part*> rows_;
  std::vector<std::uint32_t> base_rows_;  // the row in the base, or kChanged
  mutable std::once_flag all_made_, search_made_;
  mutable PartVector all_;
  mutable std::unique_ptr<const PartSearch> search_;  // over the rows that are kChanged
};

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_ROWS_REVISION_ROWS_H_
