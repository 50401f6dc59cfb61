// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command.h"
#include "pipeline/demo/demo_database.h"

namespace abrdf {

void addDemo(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command =
        app.add_subcommand("demo", "a licence-free BTF database to try everything on");
    command->footer("Example: abrdf demo cloth.zip --size 64");
    struct Options {
        std::filesystem::path target;
        DemoOptions demo;
    };
    auto options = std::make_shared<Options>();
    command->add_option("TARGET", options->target, "a new folder, or a .zip file")->required();
    command->add_option("--size", options->demo.size, "texels along each side, 1 to 1024")
        ->capture_default_str();
    command->add_option("--seed", options->demo.seed, "the same seed gives the same bytes")
        ->capture_default_str();
    command->add_flag("--hdr", options->demo.hdr, "half-float OpenEXR with true highlights");
    command
        ->add_option("--relief", options->demo.relief,
                     "stretches the cloth's heights: 0 is flat, 1 as it is woven")
        ->check(CLI::Range(0.0F, 4.0F))
        ->capture_default_str();
    command
        ->add_option("--height", options->demo.height,
                     "of the cloth above the plane of rectification, in texels")
        ->check(CLI::Range(-100.0, 100.0))
        ->capture_default_str();
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions&, const ProgressSink& progress) {
            writeDemoDatabase(options->target, options->demo, progress);
            return 0;
        };
    });
}

}  // namespace abrdf
