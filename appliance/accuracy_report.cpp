#include "appliance/accuracy_report.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace quadrig::appliance {
namespace {

std::vector<const SettingResult*> by_cost(const std::vector<SettingResult>& results) {
    std::vector<const SettingResult*> sorted;
    sorted.reserve(results.size());
    for (const SettingResult& result : results) sorted.push_back(&result);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->cost < b->cost; });
    return sorted;
}

/// What a setting has to be better by than all that are faster, dB: less is not seen.
constexpr double kGain = 0.1;

double wrong_share(const reference::VisibilityError& error) {
    return static_cast<double>(error.wrong) / static_cast<double>(error.pixels);
}

bool is_default(const SettingResult& result) { return result.quality == Quality{}; }

}  // namespace

void sum_up(std::vector<SettingResult>& results) {
    for (SettingResult& result : results) {
        const auto count = static_cast<double>(result.cameras.size());
        for (const CameraResult& camera : result.cameras) {
            result.frame_ms += camera.frame_ms / count;
            result.cost += camera.cost / count;
            result.visibility += camera.visibility;
            result.picture += camera.picture;
        }
    }
    double best = -std::numeric_limits<double>::infinity();
    for (const SettingResult* next : by_cost(results)) {
        const double psnr = next->picture.psnr();
        if (psnr < best + kGain) continue;
        results[static_cast<std::size_t>(next - results.data())].on_front = true;
        best = psnr;
    }
}

std::string accuracy_table(const std::vector<SettingResult>& results) {
    std::ostringstream out;
    out << "    frame   cost    PSNR  mean  worst  within 16  wrong pixels  depth    setting\n"
           "       ms             dB  step   step          %             %\n"
        << std::fixed;
    for (const SettingResult& result : results) {
        out << (result.on_front ? "* " : "  ") << std::setprecision(2) << std::setw(7) << result.frame_ms
            << std::setw(7) << result.cost << std::setprecision(1) << std::setw(8) << result.picture.psnr()
            << std::setprecision(2) << std::setw(6) << result.picture.mean_steps() << std::setprecision(0)
            << std::setw(7) << result.picture.worst << std::setprecision(3) << std::setw(11)
            << 100.0 * result.picture.within_16() << std::setprecision(4) << std::setw(14)
            << 100.0 * wrong_share(result.visibility) << std::scientific << std::setprecision(1) << std::setw(9)
            << result.visibility.depth << std::fixed << "  " << config::words_for(result.quality) << '\n';
    }
    out << "* on the Pareto front: no other setting is at least as fast and closer to the truth\n";
    return out.str();
}

nlohmann::ordered_json accuracy_json(const std::vector<SettingResult>& results) {
    using Json = nlohmann::ordered_json;
    const auto errors = [](Json& json, const reference::VisibilityError& visibility,
                           const reference::PictureError& picture) {
        json["identity"] = {{"pixels", visibility.pixels}, {"ties", visibility.ties}, {"wrong", visibility.wrong}};
        json["depth"] = visibility.depth;
        json["picture"] = {{"psnr_db", picture.psnr()},
                           {"mean_step", picture.mean_steps()},
                           {"worst_step", picture.worst},
                           {"within_16", picture.within_16()}};
    };
    Json all = Json::array();
    for (const SettingResult& result : results) {
        Json json{{"setting", config::words_for(result.quality)},
                  {"frame_ms", result.frame_ms},
                  {"cost", result.cost},
                  {"on_front", result.on_front}};
        errors(json, result.visibility, result.picture);
        json["cameras"] = Json::array();
        for (const CameraResult& camera : result.cameras) {
            Json seen{{"frame_ms", camera.frame_ms}, {"cost", camera.cost}};
            errors(seen, camera.visibility, camera.picture);
            json["cameras"].push_back(std::move(seen));
        }
        all.push_back(std::move(json));
    }
    return all;
}

config::QualityLadder ladder_from(const std::vector<SettingResult>& results) {
    constexpr double kLeastGain = 1.0, kLeastWorth = 38.0;  // dB
    std::vector<const SettingResult*> steps;
    for (const SettingResult* next : by_cost(results)) {
        const bool worth_having = next->on_front && next->visibility.wrong == 0 && next->picture.psnr() >= kLeastWorth;
        if (!worth_having && !is_default(*next)) continue;
        const bool gains = steps.empty() || next->picture.psnr() >= steps.back()->picture.psnr() + kLeastGain;
        if (!gains && !is_default(*next)) continue;
        // The default stays; a neighbour below that is hardly worse gives way to it.
        if (!gains && next->picture.psnr() > steps.back()->picture.psnr() - kLeastGain) steps.pop_back();
        steps.push_back(next);
    }
    const auto whole = std::find_if(steps.begin(), steps.end(), [](const SettingResult* step) {
        return pixels_across(step->quality.shading) <= 1.0;
    });
    config::QualityLadder ladder;
    for (const SettingResult* step : steps) {
        const double psnr = step->picture.psnr();
        std::string name = std::to_string(std::lround(psnr)) + "dB";
        if (is_default(*step))
            name = "default";
        else if (step == *whole)
            name = "draft";
        else if (step == steps.back())
            name = "best";
        else if (!ladder.empty() && ladder.back().name == "default")
            name = "fine";
        // As many digits as the table has, and a measurement is worth.
        ladder.push_back(
            {name, step->quality, std::max(0.01, std::round(100 * step->cost) / 100), std::round(10 * psnr) / 10});
    }
    return ladder;
}

}  // namespace quadrig::appliance
