#version 300 es
// Marches a ray through the coverage of part (red) and supports (green), to the surface of one coverage.
precision highp float;
precision highp sampler3D;

uniform sampler3D volume;
uniform sampler3D blocks;  // the largest coverage in blocks of voxels, to skip what is empty
uniform mat4 unproject;    // from the screen to mm
uniform vec3 eye;
uniform vec3 lo, hi;       // the box of the volume, mm
uniform vec3 clip_lo, clip_hi;  // what the cut leaves of it
uniform int cut_axis;      // -1: no cut
uniform float cut_at;
uniform vec3 block;        // edges of a block, mm
uniform float surface;     // coverage at the surface
uniform float voxel;       // the smallest edge of a voxel, mm
uniform float stride;      // length of a step, in voxels
uniform bool fine;         // false while the view moves: fewer samples
uniform float layer_z, layer_half;  // the layer that is marked
uniform vec3 part_colour, support_colour, cut_colour, support_cut_colour, layer_colour, grid_colour;
uniform float grid_pitch;
// By 1: codes, 0 plain, 1 softer and 2 stiffer than asked, 3 to 255 along the scale. By 2: how far it is within skin,
// frame and solid regions, one half at their boundaries.
uniform sampler3D paint;
uniform int painted_by;    // 0: nothing
uniform vec3 skin_colour, frame_colour, solid_colour, rest_colour;
uniform vec3 paint_lo, paint_hi;
uniform int faults;        // boxes that are painted
uniform vec3 fault_lo[64], fault_hi[64], fault_colour;

in vec2 at;
out vec4 colour;

vec2 coverage(vec3 p) { return texture(volume, (p - lo) / (hi - lo)).rg; }
float value(vec3 p) { vec2 c = coverage(p); return max(c.r, c.g); }

float around(vec3 p) {  // as value, but nothing is outside the box, except below the bed
    vec3 q = (p - lo) / (hi - lo);
    q.z = max(q.z, 0.0);
    vec2 c = texture(volume, q).rg;
    return all(equal(q, clamp(q, 0.0, 1.0))) ? max(c.r, c.g) : 0.0;
}

vec3 gradient(vec3 p) {  // samples on two shells, wide enough to smooth the steps between slices
    const vec3 k = vec3(1.0, -1.0, 0.0);
    float h = (fine ? 1.1 : 1.8) * voxel, g = 1.9 * voxel;
    if (!fine) {
        return -(k.xyy * around(p + k.xyy * h) + k.yyx * around(p + k.yyx * h) +
                 k.yxy * around(p + k.yxy * h) + k.xxx * around(p + k.xxx * h));
    }
    vec3 sum = k.xyy * around(p + k.xyy * h) + k.yyx * around(p + k.yyx * h) + k.yxy * around(p + k.yxy * h) +
               k.xxx * around(p + k.xxx * h) + k.yxx * around(p + k.yxx * h) + k.xxy * around(p + k.xxy * h) +
               k.xyx * around(p + k.xyx * h) + k.yyy * around(p + k.yyy * h);
    sum.x += around(p + k.xzz * g) - around(p + k.yzz * g);
    sum.y += around(p + k.zxz * g) - around(p + k.zyz * g);
    sum.z += around(p + k.zzx * g) - around(p + k.zzy * g);
    return -sum;
}

vec3 shade(vec3 base, vec3 normal, vec3 ray, vec3 p) {
    vec3 key = normalize(vec3(-ray.y, ray.x, 0.0) * 0.5 - ray + vec3(0.0, 0.0, 0.7));
    float diffuse = max(0.0, dot(normal, key));
    float sky = 0.5 + 0.5 * normal.z;
    float near = around(p + normal * voxel * 2.5), far = fine ? around(p + normal * voxel * 6.0) : near;
    float open = 1.0 - 0.35 * near - 0.3 * far;
    float shine = pow(max(0.0, dot(normal, normalize(key - ray))), 40.0) * 0.12;
    return base * (0.26 + 0.24 * sky + 0.66 * diffuse) * open + shine * open;
}

vec4 plate(vec3 origin, vec3 ray) {  // lines on the bed, which fade with the distance from the part
    if (origin.z <= lo.z || ray.z > -1e-4) return vec4(0.0);
    float t = (lo.z - origin.z) / ray.z;
    vec2 p = origin.xy + ray.xy * t;
    vec2 middle = 0.5 * (lo.xy + hi.xy);
    float reach = length(hi.xy - lo.xy);
    float fade = 1.0 - smoothstep(0.55 * reach, 1.1 * reach, length(p - middle));
    float wide = t * 0.00035 / max(-ray.z, 0.2);
    vec2 off = abs(fract(p / grid_pitch + 0.5) - 0.5) * grid_pitch;
    float line = 1.0 - smoothstep(0.5 * wide, 1.5 * wide, min(off.x, off.y));
    float alpha = line * fade * 0.55;
    return vec4(grid_colour * alpha, alpha);
}

vec3 on_scale(float share) {  // dark blue to yellow, of even steps of lightness
    vec3 scale[5] = vec3[5](vec3(0.267, 0.004, 0.329), vec3(0.231, 0.322, 0.545), vec3(0.129, 0.569, 0.549),
                            vec3(0.365, 0.784, 0.388), vec3(0.992, 0.906, 0.145));
    float place = 4.0 * clamp(share, 0.0, 1.0);
    int i = min(int(place), 3);
    return mix(scale[i], scale[i + 1], place - float(i));
}

vec3 painted(vec3 p, vec3 plain) {
    if (painted_by == 0) return plain;
    vec3 sampled = texture(paint, (p - paint_lo) / (paint_hi - paint_lo)).rgb;
    if (painted_by == 2) {
        if (sampled.b > 0.5) return solid_colour;
        if (sampled.g > 0.5) return frame_colour;
        return sampled.r > 0.5 ? skin_colour : rest_colour;
    }
    float code = floor(255.0 * sampled.r + 0.5);
    if (code < 0.5) return plain;
    if (code < 1.5) return vec3(0.93, 0.19, 0.19);
    if (code < 2.5) return vec3(0.95);
    return on_scale((code - 3.0) / 252.0);
}

bool is_faulty(vec3 p) {
    for (int i = 0; i < faults; ++i) {
        if (all(greaterThanEqual(p, fault_lo[i] - voxel)) && all(lessThanEqual(p, fault_hi[i] + voxel))) return true;
    }
    return false;
}

void main() {
    vec4 beyond = unproject * vec4(at, 1.0, 1.0);
    vec3 ray = normalize(beyond.xyz / beyond.w - eye);
    vec3 safe = mix(ray, vec3(1e-6), lessThan(abs(ray), vec3(1e-6)));
    vec3 inverse = 1.0 / safe;
    vec3 a = (clip_lo - eye) * inverse, b = (clip_hi - eye) * inverse;
    vec3 entries = min(a, b), exits = max(a, b);
    float t = max(max(entries.x, entries.y), max(entries.z, 0.0));
    float end = min(min(exits.x, exits.y), exits.z);
    colour = plate(eye, ray);
    if (t >= end) return;

    float tiny = 1e-3 * voxel;
    float first = t;
    float before = t;
    float step_length = stride * voxel;
    bool hit = false;
    for (int i = 0; i < 700; ++i) {
        vec3 p = eye + safe * (t + tiny);
        vec3 cell = floor((p - lo) / block);
        if (texelFetch(blocks, ivec3(cell), 0).r < surface) {
            vec3 side = (lo + (cell + step(0.0, safe)) * block - eye) * inverse;
            t = max(t, min(min(side.x, side.y), side.z)) + tiny;
            before = t;
        } else {
            if (value(p) >= surface) { hit = true; break; }
            before = t;
            t += step_length;
        }
        if (t >= end) break;
    }
    if (!hit) return;

    bool at_entry = t == first;
    if (!at_entry) {
        float outside = before, inside = t;
        int halvings = fine ? 5 : 4;
        for (int i = 0; i < halvings; ++i) {
            float half_way = 0.5 * (outside + inside);
            if (value(eye + safe * half_way) >= surface) inside = half_way; else outside = half_way;
        }
        t = inside;
    }
    vec3 p = eye + ray * t;
    vec2 c = coverage(p);
    bool is_support = c.g > c.r;
    bool on_cut = false;
    if (cut_axis >= 0 && at_entry) on_cut = abs(p[cut_axis] - cut_at) < 2.0 * tiny + 1e-4 * voxel;
    if (on_cut) {
        colour = vec4(is_support ? support_cut_colour : painted(p, cut_colour), 1.0);
    } else {
        vec3 normal = gradient(p);
        float size = length(normal);
        normal = size < 0.02 ? -ray : normal / size;
        if (dot(normal, ray) > 0.0) normal = normalize(normal - ray * dot(normal, ray));
        colour = vec4(shade(is_support ? support_colour : painted(p, part_colour), normal, ray, p), 1.0);
    }
    if (is_faulty(p)) colour.rgb = mix(colour.rgb, fault_colour, 0.75);
    float band = max(layer_half, 0.35 * voxel);
    float ring = 1.0 - smoothstep(band, band + 0.35 * voxel, abs(p.z - layer_z));
    if (!on_cut || cut_axis != 2) colour.rgb = mix(colour.rgb, layer_colour, 0.85 * ring);
}
