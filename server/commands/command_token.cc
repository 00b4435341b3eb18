#include <algorithm>
#include <cstdio>
#include <memory>

#include "api/catalogue/stores.h"
#include "server/call/reply.h"
#include "server/call/tokens.h"
#include "server/commands/catalog_keeping.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/output.h"

namespace plenum::server {
namespace {

constexpr std::size_t kNameLongest = 100;

struct TokenOptions {
  std::string catalog = catalog::DefaultCatalog();
  std::string name, id;
  std::string scope = "read";
  bool json = false;
};

void Create(const TokenOptions& options) {
  const bool plain = std::all_of(options.name.begin(), options.name.end(),
                                 [](char c) { return c >= ' ' && c <= '~'; });
  if (options.name.empty() || options.name.size() > kNameLongest || !plain)
    throw BadInput("NAME: must be 1 to 100 characters of visible ASCII");
  OpenCatalog(options.catalog, catalog::Access::kRead);  // says what is wrong with the file
  const Scope scope = options.scope == "write" ? Scope::kWrite : Scope::kRead;
  Print(CreateToken(TokenFile(options.catalog), options.name, scope) + "\n");
  std::fputs("Shown this once only. Send it as: Authorization: Bearer TOKEN\n", stderr);
}

void List(const TokenOptions& options) {
  api::Json list = api::Json::array();
  std::string lines;
  for (const Token& token : ReadTokens(TokenFile(options.catalog))) {
    list.push_back({{"id", token.id},
                    {"name", token.name},
                    {"scope", Name(token.scope)},
                    {"created", token.created}});
    lines += token.id + "  " + token.created + "  " +
             (token.scope == Scope::kWrite ? "write" : "read ") + "  " + token.name + "\n";
  }
  Print(options.json ? Dump({{"tokens", list}}) + "\n" : lines);
}

void Revoke(const TokenOptions& options) {
  if (!RevokeToken(TokenFile(options.catalog), options.id))
    throw BadInput("ID: no token has the id " + options.id);
}

}  // namespace

Command TokenCommand() {
  auto options = std::make_shared<TokenOptions>();
  const auto command = [&](const char* name, const char* help, const char* example,
                           std::vector<Option> table, void (*run)(const TokenOptions&)) -> Command {
    table.push_back(CatalogOption(options->catalog));
    return {name, help, example, std::move(table), [options, run] {
              run(*options);
              return kAnswered;
            }};
  };
  return {
      "token",
      "Tokens for use of the service from elsewhere",
      "plenum token create laptop --scope write",
      {},
      {},
      {command("create", "Makes a token and prints it", "plenum token create laptop",
               {Argument("NAME", "Whose it is", &options->name),
                {"--scope",
                 "What it may do",
                 &options->scope,
                 {.shows_default = true, .allowed = OneOf{"read", "write"}}}},
               Create),
       command("list", "Tokens by id, without their text", "plenum token list",
               {JsonFlag(options->json)}, List),
       command("revoke", "Ends a token, also of a running service", "plenum token revoke 1b5c09ae",
               {Argument("ID", "Of the list", &options->id)}, Revoke)}};
}

}  // namespace plenum::server
