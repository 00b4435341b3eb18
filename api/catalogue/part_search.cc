#include "api/catalogue/part_search.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "catalog/units/search_text.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

// Below, what is left of "3/2" would find "32 mm".
constexpr std::size_t kSqueezedLeast = 4;

std::string Squeezed(std::string_view words) {
  std::string squeezed(words);
  std::erase_if(squeezed, [](char c) { return c == ' ' || catalog::IsSearchSign(c); });
  return squeezed;
}

// Adds texts of parts, of which many are the same, to an index.
class Collector {
 public:
  explicit Collector(WordIndex& index) : index_(index) {}
  void Add(std::uint32_t row, std::string_view text) {
    if (text.empty()) return;
    const auto [found, is_new] = known_.try_emplace(text);
    if (is_new) found->second = index_.Enter(text);
    index_.Add(row, found->second);
  }

 private:
  WordIndex& index_;
  std::unordered_map<std::string_view, WordIndex::Words> known_;
};

// Ids and numbers are all different.
void AddNames(const catalog::Part& part, std::uint32_t row, Collector& shared, WordIndex& names) {
  names.Add(row, names.Enter(part.id));
  names.Add(row, names.Enter(part.part_number));
  for (const std::string& alias : part.aliases) names.Add(row, names.Enter(alias));
  shared.Add(row, part.manufacturer);
  shared.Add(row, part.series);
}

void AddSqueezed(const catalog::Part& part, std::uint32_t row, WordIndex& squeezed) {
  const auto add = [&](std::string_view text) {
    const std::string words = catalog::SearchWords(text);
    const std::string one = Squeezed(words);
    if (one.size() < words.size()) squeezed.Add(row, squeezed.Enter(one));
  };
  add(part.part_number);
  for (const std::string& alias : part.aliases) add(alias);
}

void AddOthers(const catalog::Part& part, std::uint32_t row, Collector& others) {
  others.Add(row, part.family);
  others.Add(row, part.notes);
  for (const auto& [field, text] : part.texts)
    others.Add(row, text.value), others.Add(row, text.source);
  for (const auto& [field, number] : part.numbers) others.Add(row, number.source);
  for (const catalog::Offer& offer : part.offers)
    others.Add(row, offer.supplier), others.Add(row, offer.link);
  for (const catalog::Document& document : part.documents) others.Add(row, document.link);
  if (!part.curve) return;
  others.Add(row, part.curve->free_air_source);
  others.Add(row, part.curve->current_source);
}

std::vector<const catalog::Part*> PointersTo(const std::vector<catalog::Part>& parts) {
  std::vector<const catalog::Part*> pointers;
  pointers.reserve(parts.size());
  for (const catalog::Part& part : parts) pointers.push_back(&part);
  return pointers;
}

}  // namespace

PartSearch::PartSearch(const std::vector<catalog::Part>& parts) : PartSearch(PointersTo(parts)) {}

PartSearch::PartSearch(const std::vector<const catalog::Part*>& parts) : parts_(parts.size()) {
  Collector names(names_), others(others_);
  for (std::uint32_t row = 0; const catalog::Part* part : parts) {
    AddNames(*part, row, names, names_);
    AddSqueezed(*part, row, squeezed_);
    AddOthers(*part, row, others);
    ++row;
  }
  for (WordIndex* index : {&names_, &others_, &squeezed_}) index->Sort();
}

std::vector<std::uint8_t> PartSearch::Find(std::string_view text) const {
  std::vector<std::uint8_t> grades(parts_, kFoundByName);
  const std::string words = catalog::SearchWords(text);
  if (words.empty()) return grades;
  Marks by_name(parts_), elsewhere(parts_);
  for (const std::string_view word : catalog::Split(words, ' ')) {
    std::fill(by_name.begin(), by_name.end(), 0);
    std::fill(elsewhere.begin(), elsewhere.end(), 0);
    names_.Find(word, by_name);
    const std::string squeezed = Squeezed(word);
    if (squeezed.size() >= kSqueezedLeast) squeezed_.Find(squeezed, by_name);
    others_.Find(word, elsewhere);
    for (std::size_t i = 0; i < parts_; ++i) {
      const std::uint8_t grade = by_name[i] ? kFoundByName : elsewhere[i] ? kFound : kNotFound;
      grades[i] = std::min(grades[i], grade);
    }
  }
  return grades;
}

}  // namespace plenum::api
