// SPDX-License-Identifier: BSD-3-Clause
#include "cli/man_page.h"

#include "cli/described_command.h"

#include <fmt/format.h>

namespace abrdf {

namespace {

/// Text in which roff sees nothing of its own: a line that begins with . or ' would be a command.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else if (c == '\'') {
            result += "\\(aq";
        } else if (c == '.' && (result.empty() || result.back() == '\n')) {
            result += "\\&.";
        } else {
            result += c;
        }
    }
    return result;
}

std::string valueOf(const DescribedOption& option) {
    switch (option.value) {
        case Value::kNone:
            return "";
        case Value::kNumber:
            return "N";
        case Value::kName:
            return "NAME";
        case Value::kFile:
            return "VALUE";
    }
    return "";
}

std::string optionText(const DescribedOption& option) {
    std::string names;
    for (const std::string& name : option.names) {
        names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", plain(name));
    }
    const std::string value = valueOf(option);
    if (!value.empty()) names += fmt::format(" \\fI{}\\fR", value);
    std::string text = option.text;
    if (!option.fallback.empty()) text += fmt::format(" (default: {})", option.fallback);
    return fmt::format(".TP\n{}\n{}\n", names, plain(text));
}

std::string commandText(const DescribedCommand& command) {
    std::string text =
        fmt::format(".SH ABRDF {0}\n\\fBabrdf {0}\\fR [\\fIOPTIONS\\fR]", command.name);
    for (const DescribedOption& positional : command.positionals) {
        text += fmt::format(" \\fI{}\\fR{}", positional.names[0], positional.many ? "..." : "");
    }
    text += fmt::format("\n.PP\n{}\n", plain(command.text));
    for (const DescribedOption& positional : command.positionals) {
        text += fmt::format(".TP\n\\fI{}\\fR\n{}\n", positional.names[0], plain(positional.text));
    }
    for (const DescribedOption& option : command.options) text += optionText(option);
    if (!command.example.empty()) text += fmt::format(".PP\n{}\n", plain(command.example));
    return text;
}

constexpr const char* kEnvironment = R"(.SH ENVIRONMENT
.TP
\fBABRDF_THREADS\fR, \fBCUE_THREADS\fR, \fBSLURM_CPUS_PER_TASK\fR
threads to use where \fB\-\-threads\fR is not given; the first that is set
.TP
\fBOCIO\fR
the OpenColorIO config where \fB\-\-colorconfig\fR is not given
.TP
\fBTMPDIR\fR
where what memory does not hold goes; else beside the output
.TP
\fBXDG_CACHE_HOME\fR
below it trained models are kept; else below ~/.cache
.TP
\fBNO_COLOR\fR
no colours in messages
.SH EXIT STATUS
.TP
\fB0\fR
done
.TP
\fB1\fR
failed; one sentence says which file, what is wrong and what to do
.TP
\fB2\fR
wrong usage
)";

}  // namespace

std::string manPage(const CLI::App& program) {
    const DescribedCommand whole = described(program);
    const std::vector<DescribedCommand> commands = describedCommands(program);
    std::string text = ".TH ABRDF 1 \"\" \"abrdf " ABRDF_VERSION "\" \"User Commands\"\n";
    text += fmt::format(".SH NAME\nabrdf \\- {}\n", plain(whole.text));
    text += ".SH SYNOPSIS\n\\fBabrdf\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR] ...\n.SH COMMANDS\n";
    for (const DescribedCommand& command : commands) {
        text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", command.name, plain(command.text));
    }
    text += ".SH OPTIONS OF EVERY COMMAND\n";
    for (const DescribedOption& option : whole.options) text += optionText(option);
    for (const DescribedCommand& command : commands) text += commandText(command);
    return text + kEnvironment;
}

}  // namespace abrdf
