#include "appliance/figure_svg.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>

#include "appliance/svg.h"

namespace quadrig::appliance {
namespace {

constexpr double kMargin = 24, kGap = 24, kTitle = 52, kCaption = 30, kLegendLine = 21, kNarrowestColumn = 430;

struct StrokeStyle {
    const char* name;  ///< in the style sheet
    const char* one;
    const char* many;
};
constexpr std::array<StrokeStyle, 4> kStrokes{{{"limb", "limb curve", "limb curve"},
                                               {"curve", "intersection curve", "intersection curves"},
                                               {"visibility", "visibility line", "visibility lines"},
                                               {"edge", "intersection line", "intersection lines"}}};

struct MarkStyle {
    const char* name;
    const char* one;
    const char* many;
    const char* path;  ///< about the key point
};
constexpr std::array<MarkStyle, 5> kMarks{
    {{"limb-extremum", "limb extremum", "limb extrema", "M0-5.4 4.8 3.5H-4.8z"},
     {"curve-extremum", "curve extremum", "curve extrema", "M0-5 5 0 0 5-5 0z"},
     {"contact", "contact point", "contact points", "M4 0A4 4 0 1 1-4 0 4 4 0 1 1 4 0z"},
     {"intersection", "intersection point", "intersection points", "M-3.7-3.7H3.7V3.7H-3.7z"},
     {"triplet", "triplet point", "triplet points",
      "M0-7 1.8-2.2 6.7-2.2 2.9.9 4.1 5.7 0 3-4.1 5.7-2.9.9-6.7-2.2-1.8-2.2z"}}};

constexpr const char* kFigureStyle = R"(<style>
text{font-family:Helvetica,Arial,sans-serif;font-size:14px;fill:#1f2933}
.title{font-size:18px;font-weight:bold}.small{fill:#52606d}
.frame{fill:none;stroke:#9aa5b1}.paper{fill:#fff}
.band{fill:#eef2f6}.level{stroke:#9fb3c8;stroke-width:.9}
path{fill:none;stroke-linecap:round;stroke-linejoin:round}
.limb{stroke:#1f2933;stroke-width:1.7}.curve{stroke:#1c64d1;stroke-width:1.4}
.visibility{stroke:#e8590c;stroke-width:1.1;stroke-dasharray:6 4}.edge{stroke:#2f9e44;stroke-width:1.1}
.seen path{stroke-width:2.6}
.mark{stroke:#fff;stroke-width:1.2;paint-order:stroke}
.limb-extremum{fill:#1f2933}.curve-extremum{fill:#1c64d1}.contact{fill:#e8590c}.intersection{fill:#2f9e44}.triplet{fill:#ae3ec9}
</style>
)";

/// RFC 4648.
std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = i; j < i + 3; ++j)
            group = group << 8 | (j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j) out += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
    return out;
}

std::string surface_name(int surface) {
    if (surface < 0) return "background";
    return surface == 0 ? "quadric" : "plane " + std::to_string(surface);
}

std::string stroke_name(const Stroke& stroke) {
    const std::string kind = kStrokes[static_cast<std::size_t>(stroke.kind)].one;
    if (stroke.kind == StrokeKind::limb) return kind;
    const auto plane = [](int surface) {
        return surface > 0 ? std::to_string(surface) : surface == kNearSurface ? "k_near" : "infinity";
    };
    if (stroke.kind == StrokeKind::intersection_line)
        return kind + " of planes " + plane(stroke.plane) + " and " + plane(stroke.other_plane);
    return kind + " of plane " + plane(stroke.plane);
}

/// Writes one panel's drawing: image coordinates become pixels from its top left corner.
class Panel {
  public:
    Panel(std::ostream& out, const Figure& figure, const config::ImageSize& size)
        : out_(out), figure_(figure), size_(size) {}

    void all_strokes() {
        for (const Stroke& stroke : figure_.strokes) path(stroke.kind, stroke.pieces, stroke_name(stroke));
    }

    void seen() {
        bool shaded = false;
        for (const FigureBand& band : figure_.bands)
            if (shaded = !shaded; shaded)
                out_ << "<rect class='band' y='" << down(band.z_to) << "' width='" << size_.width << "' height='"
                     << down(band.z_from) - down(band.z_to) << "'/>\n";
        for (const double z : levels())
            out_ << "<path class='level' d='M0 " << down(z) << 'H' << size_.width << "'/>\n";
        out_ << "<g class='seen'>\n";
        for (const VisibleSegment& segment : figure_.segments)
            path(segment.kind, segment.pieces,
                 std::string(kStrokes[static_cast<std::size_t>(segment.kind)].one) + " between " +
                     surface_name(segment.left) + " and " + surface_name(segment.right));
        out_ << "</g>\n";
        for (const FigureKeyPoint& key : figure_.key_points) {
            const MarkStyle& mark = kMarks[static_cast<std::size_t>(key.kind)];
            out_ << "<path class='mark " << mark.name << "' transform='translate(" << across(key.at.x) << ' '
                 << down(key.at.y) << ")' d='" << mark.path << "'><title>" << mark.one << "</title></path>\n";
        }
    }

  private:
    [[nodiscard]] double across(double x) const {
        return (x - figure_.window.x_from) / figure_.window.width() * size_.width;
    }
    [[nodiscard]] double down(double z) const {
        return (figure_.window.z_to - z) / figure_.window.height() * size_.height;
    }

    [[nodiscard]] std::vector<double> levels() const {
        std::vector<double> all;
        for (const FigureBand& band : figure_.bands) {
            all.push_back(band.z_from);
            all.push_back(band.z_to);
        }
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }

    void path(StrokeKind kind, const std::vector<Polyline>& pieces, const std::string& title) {
        out_ << "<path class='" << kStrokes[static_cast<std::size_t>(kind)].name << "' d='";
        for (const Polyline& piece : pieces) {
            char command = 'M';
            for (const glm::dvec2& p : piece) {
                out_ << command << across(p.x) << ' ' << down(p.y);
                command = command == 'M' ? 'L' : ' ';
            }
        }
        out_ << "'><title>" << title << "</title></path>\n";
    }

    std::ostream& out_;
    const Figure& figure_;
    config::ImageSize size_;
};

struct LegendEntry {
    std::string symbol, text;
};

std::string counted(std::ptrdiff_t count, const char* one, const char* many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::vector<LegendEntry> stroke_legend(const Figure& figure) {
    std::vector<LegendEntry> legend;
    for (std::size_t kind = 0; kind < kStrokes.size(); ++kind) {
        const auto count = std::count_if(figure.strokes.begin(), figure.strokes.end(), [&](const Stroke& stroke) {
            return stroke.kind == static_cast<StrokeKind>(kind);
        });
        if (count > 0)
            legend.push_back(
                {std::string("<path class='") + kStrokes[kind].name + "' d='M-14 0H14'/>",
                 count == 1 ? kStrokes[kind].one : counted(count, kStrokes[kind].one, kStrokes[kind].many)});
    }
    return legend;
}

std::vector<LegendEntry> seen_legend(const Figure& figure) {
    std::vector<LegendEntry> legend;
    for (std::size_t kind = 0; kind < kMarks.size(); ++kind) {
        const auto count = std::count_if(
            figure.key_points.begin(), figure.key_points.end(),
            [&](const FigureKeyPoint& key) { return key.kind == static_cast<FigureKeyPoint::Kind>(kind); });
        if (count > 0)
            legend.push_back(
                {std::string("<path class='mark ") + kMarks[kind].name + "' d='" + kMarks[kind].path + "'/>",
                 counted(count, kMarks[kind].one, kMarks[kind].many)});
    }
    const auto bands = static_cast<std::ptrdiff_t>(figure.bands.size());
    legend.push_back(
        {"<rect class='band' x='-14' y='-7' width='28' height='14'/><path class='level' d='M-14-7H14M-14 7H14'/>",
         counted(bands, "z-band", "z-bands") + (figure.solved_by_row ? ", found row by row" : "")});
    return legend;
}

/// Two columns, from left to right.
void write_legend(std::ostream& out, const std::vector<LegendEntry>& legend, double column_width) {
    for (std::size_t i = 0; i < legend.size(); ++i)
        out << "<g transform='translate(" << 14.0 + 0.5 * column_width * static_cast<double>(i % 2) << ' '
            << kLegendLine * static_cast<double>(i / 2) << ")'>" << legend[i].symbol << "<text x='24' y='5'>"
            << legend[i].text << "</text></g>\n";
}

std::size_t legend_lines(const FigureRow& row) {
    return (std::max(stroke_legend(row.figure).size(), seen_legend(row.figure).size()) + 1) / 2;
}

void write_row(std::ostream& out, const FigureRow& row, const config::ImageSize& panel, double column_width) {
    out << "<text class='title' y='16'>" << escaped(row.title) << "</text>\n<text class='small' y='38'>"
        << escaped(row.subtitle) << "</text>\n";
    constexpr std::array<const char*, 3> kCaptions{
        "a. All curves and lines", "b. Visible boundary segments and z-bands", "c. Shaded visible surfaces"};
    for (std::size_t i = 0; i < kCaptions.size(); ++i) {
        out << "<g transform='translate(" << static_cast<double>(i) * (column_width + kGap) << ' ' << kTitle << ")'>\n";
        if (i == 2)
            out << "<image width='" << panel.width << "' height='" << panel.height << "' href='data:image/png;base64,"
                << base64(row.picture) << "'/>\n";
        else if (i == 1)
            Panel(out, row.figure, panel).seen();
        else
            Panel(out, row.figure, panel).all_strokes();
        out << "<rect class='frame' width='" << panel.width << "' height='" << panel.height << "'/>\n<text y='"
            << panel.height + 20 << "'>" << kCaptions[i] << "</text>\n";
        out << "<g transform='translate(0 " << panel.height + kCaption + 15 << ")'>\n";
        if (i < 2) write_legend(out, i == 0 ? stroke_legend(row.figure) : seen_legend(row.figure), column_width);
        out << "</g>\n</g>\n";
    }
}

}  // namespace

std::string figure_svg(const std::vector<FigureRow>& rows, const config::ImageSize& panel) {
    const double column_width = std::max<double>(panel.width, kNarrowestColumn);
    const double width = 2 * kMargin + 3 * column_width + 2 * kGap;
    const auto row_height = [&](const FigureRow& row) {
        return kTitle + panel.height + kCaption + kLegendLine * static_cast<double>(legend_lines(row)) + kMargin;
    };
    double height = kMargin;
    for (const FigureRow& row : rows) height += row_height(row);
    std::ostringstream out;
    out.setf(std::ios::fixed);
    out.precision(2);
    out << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << height << "' viewBox='0 0 "
        << width << ' ' << height << "'>\n"
        << kFigureStyle << "<rect class='paper' width='" << width << "' height='" << height << "'/>\n";
    double top = kMargin;
    for (const FigureRow& row : rows) {
        out << "<g transform='translate(" << kMargin << ' ' << top << ")'>\n";
        write_row(out, row, panel, column_width);
        out << "</g>\n";
        top += row_height(row);
    }
    out << "</svg>\n";
    return out.str();
}

}  // namespace quadrig::appliance
