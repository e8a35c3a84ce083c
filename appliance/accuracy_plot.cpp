#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "appliance/accuracy_report.h"
#include "appliance/svg.h"

namespace quadrig::appliance {
namespace {

constexpr double kWidth = 860, kHeight = 560, kLeft = 64, kRight = 24, kTop = 56, kBottom = 56;

constexpr const char* kStyle =
    "<style>text{font-family:Helvetica,Arial,sans-serif;font-size:12px;fill:#1f2933}.title{font-size:16px;"
    "font-weight:bold}.grid{stroke:#dde3e9}.front{fill:none;stroke:#1c64d1;stroke-width:1.6}"
    ".other{fill:#9aa5b1}.on{fill:#1c64d1}.named{fill:#e8590c}</style>\n";

/// Frame time is drawn by its logarithm, so that a ratio is the same length everywhere; PSNR is one already.
class Axes {
  public:
    explicit Axes(const std::vector<SettingResult>& results) {
        double fastest = 1e300, slowest = 0.0, worst = 1e300, best = 0.0;
        for (const SettingResult& result : results) {
            fastest = std::min(fastest, result.frame_ms), slowest = std::max(slowest, result.frame_ms);
            const double psnr = result.picture.psnr();
            if (!std::isfinite(psnr)) continue;
            worst = std::min(worst, psnr), best = std::max(best, psnr);
        }
        from_ms = fastest / 1.08, to_ms = slowest * 1.08;
        from_db = 2.0 * std::floor(worst / 2.0 - 0.5),
        to_db = std::max(from_db + 2.0, 2.0 * std::ceil(best / 2.0 + 0.5));
    }
    [[nodiscard]] double x(double ms) const {
        return kLeft + (kWidth - kLeft - kRight) * std::log(ms / from_ms) / std::log(to_ms / from_ms);
    }
    [[nodiscard]] double y(double db) const {
        return kHeight - kBottom - (kHeight - kTop - kBottom) * (std::min(db, to_db) - from_db) / (to_db - from_db);
    }
    double from_ms, to_ms, from_db, to_db;
};

void draw_grid(std::ostream& out, const Axes& axes) {
    const auto line = [&](double x1, double y1, double x2, double y2) {
        out << "<path class=\"grid\" d=\"M" << x1 << ' ' << y1 << 'L' << x2 << ' ' << y2 << "\"/>\n";
    };
    for (double db = axes.from_db; db <= axes.to_db; db += 2.0) {
        line(kLeft, axes.y(db), kWidth - kRight, axes.y(db));
        out << "<text x=\"" << kLeft - 8 << "\" y=\"" << axes.y(db) + 4 << "\" text-anchor=\"end\">" << db
            << "</text>\n";
    }
    // 1, 2, 3, 5, 7 times powers of ten.
    for (double decade = std::pow(10.0, std::floor(std::log10(axes.from_ms))); decade < axes.to_ms; decade *= 10.0) {
        for (const double digit : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
            const double ms = digit * decade;
            if (ms < axes.from_ms || ms > axes.to_ms) continue;
            line(axes.x(ms), kTop, axes.x(ms), kHeight - kBottom);
            out << "<text x=\"" << axes.x(ms) << "\" y=\"" << kHeight - kBottom + 18 << "\" text-anchor=\"middle\">"
                << ms << "</text>\n";
        }
    }
    out << "<text x=\"" << 0.5 * kWidth << "\" y=\"" << kHeight - 14
        << "\" text-anchor=\"middle\">frame time, ms (median)</text>\n<text x=\"18\" y=\"" << 0.5 * kHeight
        << "\" text-anchor=\"middle\" transform=\"rotate(-90 18 " << 0.5 * kHeight
        << ")\">PSNR against the converged reference, dB (linear light)</text>\n";
}

}  // namespace

std::string accuracy_plot(const std::vector<SettingResult>& results, const std::string& title) {
    const Axes axes(results);
    std::ostringstream out;
    out << std::setprecision(4) << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kWidth << ' '
        << kHeight << "\" width=\"" << kWidth << "\" height=\"" << kHeight << "\">\n"
        << kStyle << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<text class=\"title\" x=\"" << kLeft
        << "\" y=\"30\">" << escaped(title) << "</text>\n";
    draw_grid(out, axes);

    std::vector<const SettingResult*> front;
    for (const SettingResult& result : results)
        if (result.on_front) front.push_back(&result);
    std::sort(front.begin(), front.end(), [](const auto* a, const auto* b) { return a->cost < b->cost; });
    out << "<path class=\"front\" d=\"";
    for (std::size_t i = 0; i < front.size(); ++i)
        out << (i == 0 ? 'M' : 'L') << axes.x(front[i]->frame_ms) << ' ' << axes.y(front[i]->picture.psnr());
    out << "\"/>\n";

    const config::QualityLadder ladder = ladder_from(results);
    for (const SettingResult& result : results) {
        const auto step = std::find_if(ladder.begin(), ladder.end(),
                                       [&](const config::QualityStep& s) { return s.quality == result.quality; });
        const double x = axes.x(result.frame_ms), y = axes.y(result.picture.psnr());
        std::ostringstream words;
        words << config::words_for(result.quality) << ": " << std::setprecision(4) << result.frame_ms << " ms, "
              << result.picture.psnr() << " dB";
        out << "<circle class=\""
            << (step != ladder.end() ? "named"
                : result.on_front    ? "on"
                                     : "other")
            << "\" cx=\"" << x << "\" cy=\"" << y << "\" r=\"" << (step != ladder.end() ? 4.5 : 3.0) << "\"><title>"
            << escaped(words.str()) << "</title></circle>\n";
        if (step != ladder.end())
            out << "<text x=\"" << x - 7 << "\" y=\"" << y - 7 << "\" text-anchor=\"end\">" << escaped(step->name)
                << "</text>\n";
    }
    out << "</svg>\n";
    return out.str();
}

}  // namespace quadrig::appliance
