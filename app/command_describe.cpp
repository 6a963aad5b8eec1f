// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/base/units.hpp"
#include "piola/simulation/case_schema.hpp"
#include "commands.hpp"
#include "man_page.hpp"
#include "manual.hpp"
#include "streams.hpp"
#include <cstdio>
#include <fmt/format.h>
#include <memory>

namespace piola::app {
namespace {

struct DescribeArguments {
  std::string kind, name;
  bool markdown = false, schema = false;
};

using Describe = std::string (*)(std::string const& name, Layout layout);

/// Converts 0 and 1 of a unit to SI base units: the offset, and with it the factor.
std::string describe_unit(std::string const& name, Layout) {
  std::string text;
  for (char const* const number : {"0 ", "1 "}) {
    Quantity const quantity = read_any_quantity(number + name);
    if (quantity.problem || !is_unit(name))
      throw InputError(in_quotes(name) + " is not a unit (allowed: those of UDUNITS-2 such as MPa, kN/mm or degC) - " +
                       "correct the spelling");
    text += fmt::format("{}{} = {} in SI units\n", number, name, quantity.value);
  }
  return text;
}

struct Topic {
  std::string_view kind;
  Describe describe;
};
constexpr std::array topics{
    Topic{"case", describe_case},      Topic{"material", describe_materials},       Topic{"library", describe_library},
    Topic{"kernel", describe_kernels}, Topic{"formulation", describe_formulations}, Topic{"unit", describe_unit}};

int describe(DescribeArguments const& options, CLI::App const& program) {
  Layout const layout = options.markdown ? Layout::markdown : Layout::plain;
  if (options.kind.empty() && !options.schema) {
    write_out(options.markdown ? manual_page() : overview());
    return with_output(completed);
  }
  if (options.schema && (options.kind != "case" || !options.name.empty() || options.markdown))
    throw InputError("--schema is for the whole of a case file - write 'piola describe case --schema'");
  if (options.schema) {
    write_out(case_schema());
    return with_output(completed);
  }
  if (options.kind == "man-page" || options.kind == "completion") {
    write_out(options.kind == "completion" ? bash_completion(program) : man_page(program));
    return with_output(completed);
  }
  std::vector<std::string> known;
  for (Topic const& topic : topics) {
    if (topic.kind == options.kind) {
      write_out(topic.describe(options.name, layout));
      return with_output(completed);
    }
    known.emplace_back(topic.kind);
  }
  throw InputError(in_quotes(options.kind) + " cannot be described (allowed: " + joined(known) + ") - " +
                   advice_for_name(options.kind, known));
}

}  // namespace

void add_describe(CLI::App& program, Action& action) {
  auto const options = std::make_shared<DescribeArguments>();
  CLI::App* command =
      program.add_subcommand("describe", "Explain materials, kernels, formulations and the keys of a case file");
  command->add_option(
      "kind", options->kind,
      "material, library, kernel, formulation, case or unit; all in short if left out; man-page or completion: of "
      "this program, for man and bash");
  command->add_option("name", options->name,
                      "which one, e.g. neo_hookean or MPa; for a case a section, e.g. body.shape");
  command->add_flag("--markdown", options->markdown,
                    "As a page of the manual; alone: the whole page docs/user/case-reference.md");
  command->add_flag("--schema", options->schema,
                    "case: as a JSON Schema, with which editors complete and check the keys of case files");
  command->callback(
      [options, &action, &program] { action = [options, &program] { return describe(*options, program); }; });
}

}  // namespace piola::app
