// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/input/body_properties.hpp"
#include "piola/input/check_case.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/report/page.hpp"
#include "piola/report/verification_page.hpp"
#include "piola/report/verification_plots.hpp"
#include "piola/verification/verification_report.hpp"
#include "commands.hpp"
#include "run_support.hpp"
#include "signals.hpp"
#include "streams.hpp"
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace piola::app {
namespace {

namespace fs = std::filesystem;

struct VerifyArguments {
  CaseOptions with;
  std::vector<std::string> names;
  std::string cases, out, markdown, report;
  bool short_only = false, json = false;
};

/// A new folder with a unique, unpredictable name, removed by the destructor.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "piola-verify-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw FileError(write_error_text(name, errno));
    path_ = name;
  }
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path const& path() const { return path_; }

 private:
  fs::path path_;
};

/// One line on stderr that is renewed on a terminal, otherwise one line for each run.
class ProgressLine {
 public:
  ProgressLine() : terminal_(::isatty(STDERR_FILENO) != 0) {}
  ProgressLine(ProgressLine const&) = delete;
  ProgressLine& operator=(ProgressLine const&) = delete;
  ~ProgressLine() {
    if (shown_ > 0) print_message("\r{:{}}\r", "", shown_);
  }

  void show(VerifyProgress const& at) {
    std::string line = fmt::format("[{} of {}] {} ({})", at.number, at.count, at.case_name, at.variant);
    if (terminal_) line += fmt::format("  {:.0f} %", 100 * std::clamp(at.share, 0.0, 1.0));
    if (at.seconds_left) line += fmt::format("  about {} left", duration_text(*at.seconds_left));
    if (terminal_) {
      print_message("\r{:<{}}", line, shown_);
      shown_ = std::max(shown_, line.size());
    } else if (at.number != number_) {
      print_message("{}\n", line);
    }
    number_ = at.number;
  }

 private:
  bool terminal_;
  std::size_t shown_ = 0, number_ = 0;
};

/// Particle steps of a run, from the initial wave speeds; the cost of a step is measured by the clock.
double work_of(fs::path const& file, std::vector<std::string> const& overrides) {
  CaseSpec const spec = read_case(file, overrides);
  ParticleSet const particles = make_particles(spec);
  return static_cast<double>(particles.size()) * spec.run.end / step_estimate(spec, body_properties(spec, particles));
}

// For the page only: one small picture of the end.
void keep_the_last_picture(OutputSpec& output, double end) {
  constexpr int width = 500;
  if (output.pictures.every <= 0) return;
  output.pictures.every = end;
  output.pictures.scale = 0.5;
  if (output.pictures.width <= width) return;
  output.pictures.height = std::max(16, output.pictures.height * width / output.pictures.width);
  output.pictures.width = width;
}

int run_verify(VerifyArguments const& options) {
  if (!options.report.empty()) report::require_page_name(options.report);
  catch_stop_signals();
  std::unique_ptr<TemporaryFolder> scratch;
  if (options.out.empty()) scratch = std::make_unique<TemporaryFolder>();
  auto const with_own = [&](std::vector<std::string> all) {
    auto const own = options.with.overrides();
    all.insert(all.end(), own.begin(), own.end());
    return all;
  };
  VerifyOptions const what{.cases = options.cases.empty() ? data_folder("cases", "cases") : fs::path(options.cases),
                           .names = options.names,
                           .short_only = options.short_only,
                           .out = scratch ? scratch->path() : fs::path(options.out),
                           .weigh = [&](fs::path const& file, std::vector<std::string> const& variant) {
                             return work_of(file, with_own(variant));
                           }};
  auto const prepare = [&](fs::path const& file, std::vector<std::string> const& variant) {
    CaseSpec spec = read_case(file, with_own(variant));
    if (scratch) spec.output.frames_every = 0;
    if (scratch && options.markdown.empty() && options.report.empty()) spec.output.pictures.every = 0;
    if (scratch) keep_the_last_picture(spec.output, spec.run.end);
    return build(std::move(spec));
  };
  std::vector<CaseVerification> cases;
  {
    ProgressLine line;
    cases = verify(
        what, prepare, [&](VerifyProgress const& at) { line.show(at); }, stop_signal);
  }
  write_out(options.json ? verification_json(cases) : verification_table(cases));
  auto const plots_of = [&](CaseVerification const& c) { return report::verification_plots(c, what.out); };
  if (!options.markdown.empty()) write_verification_page(options.markdown, cases, plots_of);
  if (!options.report.empty()) report::write_verification_report(options.report, cases, what.out);
  if (stop_signal != 0) return stopped_by_signal;
  return with_output(all_accepted(cases) ? completed : internal_error);
}

}  // namespace

void add_verify(CLI::App& program, Action& action) {
  auto const options = std::make_shared<VerifyArguments>();
  CLI::App* command = program.add_subcommand(
      "verify", "Run cases and compare with published numbers; exit code 1 if one falls short unexpectedly");
  command->add_option("names", options->names, "Cases, or folders of cases (default: all)");
  command->add_flag("--short", options->short_only, "Only the variants that take seconds");
  command->add_flag("--json", options->json, "Print one JSON document");
  command->add_option("--markdown", options->markdown, "Also write the page DIR/README.md, with pictures and plots");
  command->add_option("--report", options->report, "Also write one HTML page, with plots and pictures of each run");
  command->add_option("--cases", options->cases, "Folder of the cases (default: those that came with the program)");
  command->add_option("--out,-o", options->out,
                      "Keep the results in this folder (default: a temporary one, without frames and pictures)");
  options->with.add_to(*command, false);
  command->callback([options, &action] { action = [options] { return run_verify(*options); }; });
}

}  // namespace piola::app
