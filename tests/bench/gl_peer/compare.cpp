/// bench_gl_peer: the image generator and the GL peer take turns at the same views of the same scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "config/camera_path.h"
#include "config/scene_file.h"
#include "display/atomic_file.h"
#include "display/channel.h"
#include "display/png_file.h"
#include "frame_scheduler/machine.h"
#include "ig_core/image_generator.h"
#include "ig_core/reference/error.h"
#include "tests/bench/gl_peer/gl_peer.h"
#include "tests/bench/gl_peer/picture_difference.h"

namespace quadrig::gl_peer {
namespace {

struct Options {
    std::filesystem::path scene, path, json, png;
    std::string size = "1920x1080";
    int width = 0, height = 0;
    int runs = 5, reference = 0;
    bool forward = false;
    int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

template <class Draw>
double milliseconds(Draw&& draw) {
    const auto begun = std::chrono::steady_clock::now();
    draw();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
}

struct Contestants {
    display::Channel channel;
    ImageGenerator generator;
    GlPeer peer;
    Contestants(const Scene& scene, const Options& o)
        : channel(o.width, o.height),
          generator(scene, o.threads),
          peer(scene, o.width, o.height, o.forward ? Shading::forward : Shading::deferred) {}
};

nlohmann::ordered_json compare(Contestants& c, const View& view, const Options& options, std::size_t camera) {
    View eye = view;
    const auto draw_ours = [&](const Quality& quality) { c.generator.render(eye, {}, quality, c.channel.image()); };
    FrameImage peers;
    std::vector<double> ours_ms, peer_ms, ratios;
    draw_ours({}), peers = c.peer.render(view);  // memory and compiled shaders are there from here on
    for (int run = 0; run < options.runs; ++run) {
        // The eye moves up to its place by a millimetre a frame: what a still one may keep does not count.
        eye.eye.metres.x = view.eye.metres.x + 1e-3 * (options.runs - 1 - run);
        ours_ms.push_back(milliseconds([&] { draw_ours({}); }));
        peer_ms.push_back(milliseconds([&] { peers = c.peer.render(eye); }));
        ratios.push_back(peer_ms.back() / ours_ms.back());
    }
    const FrameImage ours = c.channel.image();
    nlohmann::ordered_json result{{"camera", camera + 1},
                                  {"ours_ms", median(ours_ms)},
                                  {"peer_ms", median(peer_ms)},
                                  {"ratio", median(ratios)},
                                  {"psnr", psnr_between(ours, peers)}};
    if (options.reference > 0) {
        const auto exact = reference::picture(c.generator.scene(), view, {}, options.reference);
        result["ours_psnr_exact"] = reference::picture_error(ours, exact).psnr();
        result["peer_psnr_exact"] = reference::picture_error(peers, exact).psnr();
    }
    const std::string name =
        options.scene.stem().string() + "_" + options.path.stem().string() + "_" + std::to_string(camera + 1);
    if (!options.png.empty()) {
        display::write_png(options.png / (name + "_ours.png"), ours, display::PngCompression::fast);
        display::write_png(options.png / (name + "_peer.png"), peers, display::PngCompression::fast);
    }
    Quality at_centres;
    at_centres.sub_scan_lines = 0;
    draw_ours(at_centres);
    result["psnr_at_centres"] = psnr_between(ours, peers);
    result["runs"] = {{"ours_ms", ours_ms}, {"peer_ms", peer_ms}};
    return result;
}

void run(const Options& options) {
    const Scene scene = config::read_scene(options.scene);
    const auto cameras = config::read_camera_path(options.path);
    Contestants contestants(scene, options);
    const scheduler::Machine machine = scheduler::this_machine();
    nlohmann::ordered_json report{{"scene", options.scene.string()},
                                  {"path", options.path.string()},
                                  {"size", options.size},
                                  {"machine", machine.cpu},
                                  {"cores", machine.cores},
                                  {"build", machine.build},
                                  {"compiler", QUADRIG_COMPILER},
                                  {"threads", options.threads},
                                  {"simd", ImageGenerator::simd_target()},
                                  {"peer", contestants.peer.renderer()},
                                  {"peer_shading", options.forward ? "forward" : "deferred"},
                                  {"reference_samples", options.reference}};
    std::printf("camera  ours ms  peer ms  ratio  PSNR ours/peer  at pixel centres  ours/exact  peer/exact\n");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const View view{cameras[i].eye, eye_from_scene_rotation(cameras[i].attitude),
                        ImagePlane::symmetric(options.width, options.height, cameras[i].horizontal_fov)};
        const auto result = compare(contestants, view, options, i);
        const auto number = [&](const char* key) { return result.value(key, std::nan("")); };
        std::printf("%6zu %8.2f %8.1f %6.2f %15.1f %17.1f %11.1f %11.1f\n", i + 1, number("ours_ms"), number("peer_ms"),
                    number("ratio"), number("psnr"), number("psnr_at_centres"), number("ours_psnr_exact"),
                    number("peer_psnr_exact"));
        std::fflush(stdout);
        report["cameras"].push_back(result);
    }
    if (options.json.empty()) return;
    const std::string text = report.dump(1) + "\n";
    display::AtomicFile file(options.json);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace
}  // namespace quadrig::gl_peer

int main(int count, char** words) {
    quadrig::gl_peer::Options options;
    CLI::App program(
        "Frame times of the image generator and of quadric impostors in GL, and how far their pictures differ");
    program.add_option("scene", options.scene, "SCENE.toml")->required();
    program.add_option("--path", options.path, "CAMERAS.json")->required();
    program.add_option("--size", options.size, "Pixels, WxH")->capture_default_str();
    program.add_option("--runs", options.runs, "Paired runs")->check(CLI::Range(1, 10000))->capture_default_str();
    program
        .add_option("--threads", options.threads, "Of the image generator; the peer has one a core (LP_NUM_THREADS)")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    program
        .add_option("--reference", options.reference, "Compare with the exact picture of N x N samples a pixel; slow")
        ->check(CLI::Range(1, 64));
    program.add_flag("--forward", options.forward,
                     "The peer paints opaque surfaces with their impostors, not afterwards");
    program.add_option("--json", options.json, "Write the figures to FILE");
    program.add_option("--png", options.png, "Write both pictures to DIRECTORY");
    CLI11_PARSE(program, count, words);
    char end = 0;
    if (std::sscanf(options.size.c_str(), "%dx%d%c", &options.width, &options.height, &end) != 2 || options.width < 1 ||
        options.height < 1 || options.width > 16384 || options.height > 16384) {
        std::cerr << "--size: expected WxH, each in 1..16384, found '" << options.size << "'\n";
        return 2;
    }
    try {
        quadrig::gl_peer::run(options);
        return 0;
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
