// Texturing function (Gardner 1984, Eq 15), light and haze.

// A texture is 15 vectors: terms and vertical variation; for each term, by rising frequency,
// (turns per metre, weight, phases along x and y), (phases half x, y, z; variance of a factor of Eq 15 due to this and
// all later terms). Phases are those at the eye, in turns.
layout(std140) uniform Textures { vec4 textures[15 * 256]; };

// Sine of an angle in turns, to 1e-3.
float sine(float turns) {
    float r = turns - round(turns);
    float parabola = r * (8.0 - 16.0 * abs(r));
    return parabola * (0.775 + 0.225 * abs(parabola));
}

// T at p (scene axes, from the eye), and the variance of what was faded out of it. `grown` is the mean square growth of the point's coordinates over a pixel: a sine
// is faded out as its argument's growth passes the sampling frequency, and terms beyond it are not computed.
vec2 texturing_function(int index, vec3 p, vec3 grown) {
    const float pi = 3.14159265;
    int at = index * 15;
    vec4 head = textures[at];
    int terms = int(head.x);
    float u = head.y;
    float common_growth = pi * pi * u * u / 8.0 * grown.z;
    float growth_x = grown.x + pi * pi / 32.0 * grown.y + common_growth;
    float growth_y = grown.y + pi * pi / 32.0 * grown.x + common_growth;
    vec2 sum = vec2(0.5), lost = vec2(0.0);
    for (int i = 0; i < terms; ++i) {
        vec4 term = textures[at + 1 + 2 * i], half_phase = textures[at + 2 + 2 * i];
        float w = term.x, fade = 4.0 * pi * pi / 36.0 * w * w;
        vec2 kept = max(vec2(0.0), 1.0 - fade * vec2(growth_x, growth_y));
        if (max(kept.x, kept.y) == 0.0) {
            lost += half_phase.w;
            break;
        }
        lost += 0.125 * term.y * term.y * (1.0 - kept * kept);
        vec3 halved = 0.5 * w * p + half_phase.xyz;
        float phase_x = w * p.x + term.z + 0.25 * sine(halved.y);
        float phase_y = w * p.y + term.w + 0.25 * sine(halved.x);
        if (u != 0.0) {
            phase_x += 0.5 * u * sine(halved.z);
            phase_y += 0.5 * u * sine(halved.z + 0.25);
        }
        sum += 0.5 * term.y * kept * vec2(sine(phase_x), sine(phase_y));
    }
    return vec2(sum.x * sum.y, sum.x * sum.x * lost.y + sum.y * sum.y * lost.x + lost.x * lost.y);
}

// The mean square growth of the scene coordinates of a surface's points over a pixel.
vec3 growth(vec3 d, float depth, vec3 normal) {
    vec3 slope = d / dot(normal, d);
    vec3 right = depth * window.z * (vec3(1, 0, 0) - normal.x * slope);
    vec3 upward = depth * window.w * (vec3(0, 0, 1) - normal.z * slope);
    mat3 turn = mat3(scene_from_eye);
    vec3 a = turn * right, b = turn * upward;
    return a * a + b * b;
}

// Colour and opacity of a surface at depth k along d, normal in eye axes, limb function g; paint as in object_record.h.
vec4 painted(vec4 colour_weight, vec4 texture_holes, vec3 d, float k, vec3 normal, float g) {
    float light = to_sun.w + (1.0 - to_sun.w) * max(0.0, dot(normal, to_sun.xyz));
    float intensity = light, opacity = 1.0;
    int pattern = int(texture_holes.x);
    if (pattern >= 0) {
        vec2 t = texturing_function(pattern, mat3(scene_from_eye) * (k * d), growth(d, k, normal));
        intensity = mix(light, t.x, colour_weight.w);
#ifdef HOLES
        float threshold = mix(texture_holes.z, texture_holes.y, g);
        float softness = sqrt(texture_holes.w * texture_holes.w + 12.0 * t.y);
        opacity = clamp((t.x - threshold) / softness + 0.5, 0.0, 1.0);
#endif
    }
    float clearness = exp2(-horizon.w * k * length(d));
    return vec4(mix(haze.rgb, intensity * colour_weight.rgb, clearness), opacity);
}

vec3 encoded(vec3 linear_light) {
    vec3 v = clamp(linear_light, 0.0, 1.0);
    return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}
