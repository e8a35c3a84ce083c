// What is seen at a pixel: object and surface, and inverse depth. Colours come later, once a pixel.
flat in vec4 record_a, record_b, record_c, record_d;
flat in int object;
layout(location = 0) out uvec2 seen;

void main() {
    vec4 b = record_b, e = record_c;
    Solid s = Solid(record_a.xyz, record_a.w, mat3(b.x, e.x, e.y, e.x, b.y, e.z, e.y, e.z, b.z), b.w, record_d.xyz,
                    int(e.w), int(record_d.w));
    Entry at = enter(s, ray(gl_FragCoord.xy));
    float u = 1.0 / at.depth;
    gl_FragDepth = near * u;
    seen = uvec2(object * 32 + at.surface, floatBitsToUint(u));
}
