// Writes the page, which is also well-formed XML; all text is escaped.
#include "app/reports/check_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/charts/peel_chart.h"
#include "app/reports/fault_picture.h"
#include "engine/checks/check_table.h"
#include "printers/common/thumbnail.h"
#include "recipe/keys/check_words.h"

namespace lamella {
namespace {

constexpr std::size_t max_cards = 10;  // cards per check
constexpr std::size_t max_side_views = 3;
constexpr int overview_pixels = 400;
constexpr int section_pixels = 400;
constexpr int side_pixels = 320;
constexpr int map_pixels = 110;

constexpr const char* style = R"(
:root{color-scheme:light}
body{font:16px/1.5 system-ui,sans-serif;color:#1d2733;background:#fff;max-width:62rem;margin:0 auto;padding:1rem}
h1{font-size:1.6rem;line-height:1.2;margin:.5rem 0}
h2{font-size:1.2rem;margin:2rem 0 .3rem}
p{margin:.4rem 0}
.head{display:flex;flex-wrap:wrap;gap:1.5rem;align-items:flex-start}
.head>div{flex:1 1 20rem}
.head img{flex:0 1 20rem;width:20rem;max-width:100%;height:auto;border-radius:.5rem}
.word{display:inline-block;min-width:2.9rem;padding:.05rem .4rem;border-radius:.3rem;text-align:center;
font-weight:600;font-size:.9rem}
.pass{background:#dff2e1;color:#14532d}
.warn{background:#fdeec3;color:#6b4700}
.FAIL{background:#f9d5d3;color:#8b1510}
.wide{overflow-x:auto}
table{border-collapse:collapse;width:100%;margin:1rem 0}
th,td{text-align:left;vertical-align:top;padding:.3rem .7rem .3rem 0;border-bottom:1px solid #dde3ea}
dl{display:grid;grid-template-columns:auto 1fr;gap:.1rem 1rem;margin:.8rem 0}
dt{color:#55626f}
dd{margin:0}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,19rem),1fr));gap:1rem;margin:1rem 0}
figure{margin:0;border:1px solid #dde3ea;border-radius:.5rem;overflow:hidden;break-inside:avoid}
figure svg,figure img{display:block;width:100%;height:auto}
figcaption{padding:.5rem .8rem;font-size:.92rem;border-top:1px solid #dde3ea}
figcaption b{font-size:1.05rem}
.key span{white-space:nowrap;margin-right:.9em}
.key i{display:inline-block;width:.8em;height:.8em;margin-right:.3em;border:1px solid #9aa5b1}
@media print{body{max-width:none;font-size:11pt}.word{border:1px solid currentColor}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

/// Capitalises the first letter of a sentence.
std::string sentence(std::string text) {
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    return text + ".";
}

std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63U] : '=';
    }
    return out;
}

std::string data_uri(const Picture& picture) { return "data:image/png;base64," + base64(png_file(picture)); }

std::string word(const CheckResult& result) {
    return fmt::format("<span class=\"word {0}\">{0}</span>", outcome_word(result));
}

/// Returns the largest number of the form 1, 2 or 5 times a power of ten that is at most this.
double round_length(double most) {
    double power = 1;
    while (power > most) power /= 10;
    while (power * 10 <= most) power *= 10;
    return 5 * power <= most ? 5 * power : 2 * power <= most ? 2 * power : power;
}

std::string scale_bar(const SectionPicture& section) {
    const double length = round_length(section.shown.size().x / 4);
    const double pixels = length / section.pixel, y = section.picture.height - 10.0;
    const std::string label = fmt::format("{:.3g} mm", length);
    return fmt::format(
        "<rect x=\"6\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"24\" rx=\"4\" fill=\"#fff\" "
        "fill-opacity=\".8\"/>"
        "<path d=\"M12 {:.1f}h{:.1f}\" stroke=\"#1d2733\" stroke-width=\"3\"/>"
        "<text x=\"12\" y=\"{:.1f}\" font-size=\"12\" fill=\"#1d2733\">{}</text>",
        y - 18, std::max(pixels, 60.0) + 12, y, pixels, y - 6, label);
}

/// Draws a ring around faults that are too small to be noticed.
std::string ring(const SectionPicture& section, const Fault& fault) {
    const dvec3 size = fault.box.size();
    if (!fault.box.empty() && std::max(size.x, size.y) > 24 * section.pixel) return "";
    const dvec2 at = section.at({fault.at.x, fault.at.y});
    return fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"18\" fill=\"none\" stroke=\"#d91c1c\" stroke-width=\"2\"/>",
        at.x, at.y);
}

/// Draws the whole layer, small, with a frame around the area of the other picture.
std::string layer_map(const Fault& fault, const Job& job, const Rect& frame, double right) {
    const Rect whole = job.bounds.rect();
    const double margin = 0.06 * std::max(whole.size().x, whole.size().y);
    const double side = std::max(whole.size().x, whole.size().y) + 2 * margin;
    const Rect shown{whole.center() - side / 2, whole.center() + side / 2};
    const SectionPicture map = draw_section(job, fault.layer, shown, map_pixels, {}, {});
    const dvec2 a = map.at({frame.lo.x, frame.hi.y}), b = map.at({frame.hi.x, frame.lo.y});
    const dvec2 lo = glm::clamp(a, 0.0, double{map_pixels}), hi = glm::clamp(b, 0.0, double{map_pixels});
    return fmt::format(
        "<g transform=\"translate({:.1f} 6)\"><image width=\"{}\" height=\"{}\" href=\"{}\"/>"
        "<rect width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#9aa5b1\"/>"
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#d91c1c\" "
        "stroke-width=\"1.5\"/></g>",
        right - map_pixels - 6, map_pixels, map_pixels, data_uri(map.picture), map_pixels, map_pixels, lo.x,
        lo.y, hi.x - lo.x, hi.y - lo.y);
}

std::string picture(const Fault& fault, const std::string& what, const CheckReport& report, const Job& job) {
    const Rect frame = about_fault(fault, report.band, job);
    const SectionPicture section =
        draw_section(job, fault.layer, frame, section_pixels, fault.runs, report.band);
    const int w = section.picture.width, h = section.picture.height;
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">"
        "<image width=\"{}\" height=\"{}\" href=\"{}\"/>{}{}{}</svg>",
        w, h, escaped(what), w, h, data_uri(section.picture), ring(section, fault), scale_bar(section),
        layer_map(fault, job, frame, w));
}

std::string card(const CheckResult& result, const Fault& fault, std::size_t number, const CheckReport& report,
                 const Job& job) {
    const std::string size = size_text(result.check, fault.size);
    const std::string where = fmt::format("{} at {}", size, place_text(fault.at));
    const dvec3 box = fault.box.empty() ? dvec3(0) : fault.box.size();
    const std::string wrong = check_name(result.check) + ": " + where;
    std::string side;
    if (number <= max_side_views && !fault.runs.empty())
        side = fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}, from the side\" src=\"{}\"/>",
                           side_pixels, side_pixels * 3 / 4, escaped(wrong),
                           data_uri(draw_fault(job, fault, report.band, side_pixels)));
    return fmt::format(
        "<figure>{}{}<figcaption><b>{}. {}</b><br/>at {}<br/>{}, in a box of {:.4g} x {:.4g} x {:.4g} mm<br/>"
        "section of layer {}, {:.2f} mm over the plate</figcaption></figure>\n",
        picture(fault, wrong, report, job), side, number, size, place_text(fault.at), layers_text(fault),
        box.x, box.y, box.z, fault.layer, job.layers.middle(fault.layer));
}

std::string section_of(const CheckResult& result, const CheckOutcome& outcome, const Job& job) {
    std::string text = fmt::format(
        "<h2 id=\"{0}\">{1} {0}</h2>\n<p>{2} {3}</p>\n<p>Asked for: {4}. Found: {5}{6}.</p>\n",
        check_name(result.check), word(result), escaped(sentence(check_fault(result.check))),
        escaped(check_advice(result.check)), escaped(check_limit(result.check, outcome.plan.options.limits)),
        places_text(result.count),
        check_info(result.check).adds_up ? ", " + size_text(result.check, result.total) + " in all" : "");
    const std::size_t cards = std::min(result.worst.size(), max_cards);
    if (result.count > cards) text += fmt::format("<p>The worst {} are shown.</p>\n", cards);
    text += "<div class=\"cards\">\n";
    for (std::size_t i = 0; i < cards; ++i) text += card(result, result.worst[i], i + 1, outcome.report, job);
    return text + "</div>\n";
}

std::string results_table(const CheckOutcome& outcome) {
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>check</th><th>asked for</th><th>verdict</th>"
        "<th>found</th></tr></thead><tbody>\n";
    for (const CheckResult& result : outcome.report.results) {
        const std::string name = check_name(result.check);
        text += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                            result.passed() ? name : fmt::format("<a href=\"#{0}\">{0}</a>", name),
                            escaped(check_limit(result.check, outcome.plan.options.limits)), word(result),
                            result.passed() ? "" : places_text(result.count));
    }
    return text + "</tbody></table></div>\n";
}

std::string facts(const CheckOutcome& outcome, const Job& job) {
    const dvec3 size = job.bounds.size();
    std::string text = fmt::format(
        "<dl><dt>machine</dt><dd>{} ({})</dd><dt>size</dt><dd>{:.5g} x {:.5g} x {:.5g} mm{}</dd>"
        "<dt>layers</dt><dd>{} of {}</dd><dt>material</dt><dd>{:.1f} mm3</dd>"
        "<dt>looked at</dt><dd>in rows {:.3g} mm apart</dd></dl>\n",
        escaped(outcome.machine), process_name(outcome.plan.process), size.x, size.y, size.z,
        job.supports ? " with supports" : "", job.layers.count(), job.layers.heights_text(),
        outcome.report.volume, outcome.plan.options.pitch);
    if (const std::string out = left_out(outcome.report); !out.empty())
        text += fmt::format("<p>Not looked at: {}.</p>\n", out);
    for (const std::string& note : outcome.plan.notes) text += fmt::format("<p>{}</p>\n", escaped(note));
    return text;
}

std::string overview(const Job& job) {
    if (!job.picture) return "";
    const Picture drawn = job.picture(overview_pixels);
    return fmt::format("<img width=\"{}\" height=\"{}\" alt=\"The part\" src=\"{}\"/>\n", drawn.width,
                       drawn.height, data_uri(drawn));
}

constexpr const char* colours =
    "<p>Sections are seen from above, each with its whole layer in the corner.</p>\n<p class=\"key\">"
    "<span><i style=\"background:#d91c1c\"></i>what is wrong</span> "
    "<span><i style=\"background:#99a6b3\"></i>part</span> "
    "<span><i style=\"background:#598fcc\"></i>supports</span> "
    "<span><i style=\"background:#e3e8ed\"></i>the layer below</span></p>\n";

std::string peel_section(const PeelCurve& curve, double limit, const Job& job) {
    return "<h2>Peel</h2>\n<p>The vat's film pulls at each layer in proportion to its area, and what lies "
           "below must hold. The red line is the limit.</p>\n<figure>" +
           peel_chart(curve, limit, job.layers) + "</figure>\n";
}

}  // namespace

std::string check_page(const CheckOutcome& outcome, const Job& job) {
    const CheckReport& report = outcome.report;
    const std::string title =
        fmt::format("Can {} be printed on {}?", escaped(outcome.part), escaped(outcome.machine));
    std::string text = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\" xmlns=\"http://www.w3.org/1999/xhtml\">\n<head>\n"
        "<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
        "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<div class=\"head\"><div>\n<h1>{0}</h1>\n",
        title, style);
    text += fmt::format("<p><b>{} {}</b></p>\n",
                        report.passed() ? "Yes:" : "Not as it is:", verdict_text(report) + ".");
    text += facts(outcome, job) + "</div>\n" + overview(job) + "</div>\n" + results_table(outcome);
    const bool faults = std::ranges::any_of(report.results, [](const CheckResult& r) { return !r.passed(); });
    if (faults) text += colours;
    for (const CheckResult& result : report.results) {
        if (!result.passed()) text += section_of(result, outcome, job);
    }
    if (report.peel) text += peel_section(*report.peel, outcome.plan.options.limits.peel, job);
    return text + "</body>\n</html>\n";
}

}  // namespace lamella
