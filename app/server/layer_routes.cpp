// Layers of a job, and what is made of many: curve, volume, frames. Replies never change, so that whoever has
// one may keep it for ever.
#include <charconv>
#include <map>

#include "app/jobs/layer_content.h"
#include "app/jobs/layer_curve.h"
#include "app/jobs/layer_paths.h"
#include "app/jobs/part_modulus.h"
#include "app/jobs/part_numbers.h"
#include "app/jobs/part_structure.h"
#include "app/reports/modulus_paint.h"
#include "app/server/server_state.h"
#include "printers/common/thumbnail.h"
#include "recipe/output/preview_render.h"

namespace lamella {

namespace {

/// A request for a layer of a job.
struct Asked {
    std::shared_ptr<const ServedJob> job;
    int layer = 0;
};

Asked asked(ServerState& state, const HttpRequest& request) {
    Asked found{state.jobs.find(request.parts.at("job"))};
    const auto layer = request.parts.find("layer");
    if (layer == request.parts.end()) return found;
    const std::string& text = layer->second;
    const int count = found.job->job().layers.count();
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), found.layer);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size() || found.layer < 0 ||
        found.layer >= count)
        throw HttpError(404, "there is no such layer; accepted: 0 to " + std::to_string(count - 1));
    return found;
}

bool of_supports(const HttpRequest& request) {
    const std::string what = request.text("what", "part");
    if (what == "part") return false;
    if (what == "supports") return true;
    throw HttpError(400, "what: accepted: part, supports");
}

HttpReply mask(const Asked& asked, const HttpRequest& request, const PassControl& /*control*/) {
    constexpr double far = 1e6;
    const Rect bounds = asked.job->job().bounds.rect();
    LayerWindow window;
    window.width = request.integer("width", 800, 1, 8192);
    window.rect = {
        {request.number("x0", bounds.lo.x, -far, far), request.number("y0", bounds.lo.y, -far, far)},
        {request.number("x1", bounds.hi.x, -far, far), request.number("y1", bounds.hi.y, -far, far)}};
    if (!(window.rect.size().x > 1e-6 && window.rect.size().y > 1e-6))
        throw HttpError(400, "x0, y0, x1, y1: accepted: corners of a window, the lower one first");
    return {"image/png",
            layer_picture(*asked.job, asked.layer, window, request.integer("colors", 0, 0, 1) == 1)};
}

HttpReply runs(const Asked& asked, const HttpRequest& request, const PassControl& /*control*/) {
    constexpr double far = 1e6;
    const Rect bounds = asked.job->job().bounds.rect();
    RowBand band;
    band.hi = request.integer("columns", 640, 1, 1 << 15);
    band.count = request.integer("rows", 480, 1, 1 << 15);
    band.sub = request.integer("lines", 1, 1, 16);
    band.along_pitch = request.number("pitch_x", bounds.size().x / band.hi, -far, far);
    band.across_pitch = request.number("pitch_y", -bounds.size().y / band.count, -far, far);
    band.along_origin = request.number("x", bounds.lo.x, -far, far);
    band.across_origin = request.number("y", bounds.hi.y, -far, far);
    if (band.along_pitch == 0 || band.across_pitch == 0)
        throw HttpError(400, "pitch_x, pitch_y: accepted: sizes of a pixel that are not 0");
    return {"application/octet-stream", layer_runs(*asked.job, asked.layer, band, of_supports(request))};
}

/// A curve over the layers with as many values as the request asks for.
template <nlohmann::ordered_json (*figures)(const ServedJob&, int, const PassControl&)>
HttpReply curve(const Asked& asked, const HttpRequest& request, const PassControl& control) {
    return figures(*asked.job, request.integer("values", 400, 2, 4096), control);
}

HttpReply frame(const Asked& asked, const HttpRequest& request, const PassControl& control) {
    PreviewOptions options;
    options.width = options.height = request.integer("width", 512, 16, 2048);
    options.azimuth = request.number("azimuth", options.azimuth, -3600, 3600);
    options.elevation = request.number("elevation", options.elevation, -90, 90);
    const std::string cut = request.text("cut", "-");
    if (cut != "-" && cut != "x" && cut != "y" && cut != "z")
        throw HttpError(400, "cut: accepted: -, x, y, z");
    options.cut = cut.front();
    options.cut_at = request.number("cut_at", options.cut_at, 0, 1);
    options.threads = control.threads;
    options.steady = true;
    options.smooth = request.integer("smooth", 1, 0, 1) == 1;
    const std::string paint = request.text("paint", "none");
    if (paint != "none" && paint != "modulus") throw HttpError(400, "paint: accepted: none, modulus");
    if (paint == "modulus") options.paint = modulus_paint(asked.job->built, "paint");
    return {"image/png", png_file(asked.job->scene(options.width, control.threads)->render(options))};
}

}  // namespace

void add_layer_routes(ServerState& state) {
    using Content = std::function<HttpReply(const Asked&, const HttpRequest&, const PassControl&)>;
    using View = JobStore::View;
    const auto add = [&state](const std::string& pattern, const Content& content,
                              std::optional<View> view = {}) {
        const auto handle = [&state, content, view](const HttpRequest& request) {
            const Asked found = asked(state, request);
            const SessionWork work(state, request, view);  // before the turn: the work before it gives it up
            const ComputeTurn turn(state.turns);
            HttpReply reply = content(found, request, work.control);
            // Of the recipe's text, as machines decide more than the layers' identity.
            reply.tag = found.job->id + "-" + std::to_string(std::hash<std::string>()(request.target));
            return reply;
        };
        state.http.route("GET", "/api/jobs/{job}/" + pattern, handle);
    };
    const auto volume = [](const std::string& bytes) { return HttpReply("application/octet-stream", bytes); };
    add("layers/{layer}/mask.png", mask);
    add("layers/{layer}/runs", runs);
    add("layers/{layer}/contours",
        [](const Asked& a, const HttpRequest& request, const PassControl&) -> HttpReply {
            return layer_contours(*a.job, a.layer, request.number("tolerance", 0.02, 0.001, 10),
                                  of_supports(request));
        });
    add(
        "layers/{layer}/paths",
        [](const Asked& a, const HttpRequest&, const PassControl& control) -> HttpReply {
            return layer_paths(*a.job, a.layer, control.cancel);
        },
        View::paths);
    add("curve", curve<area_curve>);
    add("curve/islands", curve<island_curve>, View::curve);
    add("curve/time", curve<time_curve>, View::curve);
    add("volume", [volume](const Asked& a, const HttpRequest& request, const PassControl& control) {
        return volume(*a.job->coverage(request.integer("n", 96, 8, 256), control));
    });
    add("modulus", [volume](const Asked& a, const HttpRequest& request, const PassControl& control) {
        return volume(modulus_volume(*a.job, request.integer("n", 96, 8, 256), control));
    });
    add("structure", [volume](const Asked& a, const HttpRequest& request, const PassControl& control) {
        return volume(structure_volume(*a.job, request.integer("n", 96, 8, 256), control));
    });
    add("numbers", [volume](const Asked& a, const HttpRequest& request, const PassControl& control) {
        return volume(number_volume(*a.job, request.text("of"), request.integer("n", 96, 8, 256), control));
    });
    add("frame.png", frame);
}

}  // namespace lamella
