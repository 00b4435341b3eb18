#include "catalog/fields/part_lists.h"

#include <optional>
#include <utility>
#include <vector>

#include "catalog/fields/list_cell.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

// Takes members out of an object one by one; collects what is wrong.
class ObjectReader {
 public:
  ObjectReader(ListObject object, std::string what)
      : object_(std::move(object)), what_(std::move(what)) {}

  std::string Text(std::string_view name) {
    known_.push_back(name);
    const auto found = object_.find(name);
    if (found == object_.end()) return {};
    std::string value = std::move(found->second);
    object_.erase(found);
    return value;
  }

  double Number(std::string_view name, std::optional<double> fallback) {
    const std::string text = Text(name);
    const auto value = text.empty() ? fallback : ParseNumber(text);
    if (!value && error_.empty())
      error_ = what_ + ": " + std::string(name) +
               (text.empty() ? " is required" : " must be a number, is \"" + text + "\"");
    return value.value_or(0.0);
  }

  std::string Finish() {
    if (error_.empty() && !object_.empty()) {
      const std::string& name = object_.begin()->first;
      error_ = what_ + ": unknown member \"" + name +
               "\"; nearest: " + std::string(NearestName(name, known_));
    }
    return std::move(error_);
  }

 private:
  ListObject object_;
  std::string what_, error_;
  std::vector<std::string_view> known_;
};

// Hands each object of the cell to `take`, which answers what is wrong with it.
template <class Take>
std::string ReadObjects(std::string_view cell, const std::string& what, const Take& take) {
  ObjectList list = ParseObjectList(cell);
  for (std::size_t i = 0; i < list.items.size() && list.error.empty(); ++i) {
    ObjectReader reader(std::move(list.items[i]), what + " " + std::to_string(i + 1));
    take(reader);
    list.error = reader.Finish();
  }
  return std::move(list.error);
}

template <class Items, class Format>
std::string FormatList(const Items& items, const Format& format) {
  if (items.empty()) return {};
  std::string text;
  for (const auto& item : items) text += (text.empty() ? "[" : ",") + format(item);
  return text + "]";
}

}  // namespace

std::string FormatAliases(const Part& part) { return FormatList(part.aliases, QuoteJson); }

std::string FormatOffers(const Part& part) {
  return FormatList(part.offers, [](const Offer& offer) {
    return "{\"supplier\":" + QuoteJson(offer.supplier) +
           ",\"price\":" + FormatNumber(offer.price) +
           ",\"currency\":" + QuoteJson(offer.currency) + ",\"pack\":" + FormatNumber(offer.pack) +
           ",\"date\":" + QuoteJson(offer.date) + ",\"link\":" + QuoteJson(offer.link) + "}";
  });
}

std::string FormatDocuments(const Part& part) {
  return FormatList(part.documents, [](const Document& document) {
    return "{\"link\":" + QuoteJson(document.link) + ",\"sha256\":" + QuoteJson(document.sha256) +
           "}";
  });
}

std::string ReadAliases(std::string_view cell, Part& part) {
  TextList list = ParseTextList(cell);
  part.aliases = std::move(list.items);
  return std::move(list.error);
}

std::string ReadOffers(std::string_view cell, Part& part) {
  return ReadObjects(cell, "offer", [&](ObjectReader& reader) {
    Offer& offer = part.offers.emplace_back();
    offer.supplier = reader.Text("supplier");
    offer.price = reader.Number("price", std::nullopt);
    offer.currency = reader.Text("currency");
    offer.pack = reader.Number("pack", 1.0);
    offer.date = reader.Text("date");
    offer.link = reader.Text("link");
  });
}

std::string ReadDocuments(std::string_view cell, Part& part) {
  return ReadObjects(cell, "document", [&](ObjectReader& reader) {
    Document& document = part.documents.emplace_back();
    document.link = reader.Text("link");
    document.sha256 = reader.Text("sha256");
  });
}

}  // namespace plenum::catalog
