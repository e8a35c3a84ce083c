// A translucent object, blended over what is behind it; with FORWARD also an opaque one.
uniform usampler2D seen;
flat in vec4 record_a, record_b, record_c, record_d;
flat in int object;
layout(location = 0) out vec4 colour;

void main() {
    vec4 b = record_b, e = record_c;
    Solid s = Solid(record_a.xyz, record_a.w, mat3(b.x, e.x, e.y, e.x, b.y, e.z, e.y, e.z, b.z), b.w, record_d.xyz,
                    int(e.w), int(record_d.w));
    vec3 d = ray(gl_FragCoord.xy);
    Entry at = enter(s, d);
#ifdef FORWARD
    gl_FragDepth = near / at.depth;
#else
    if (1.0 / at.depth <= uintBitsToFloat(texelFetch(seen, ivec2(gl_FragCoord.xy), 0).y)) discard;
#endif
    vec3 normal = s.m * (at.depth * d - s.anchor) + s.w;
#ifdef PLANES
    if (at.surface != 0) normal = -texelFetch(planes, s.first_plane + at.surface - 1).xyz;
#endif
    colour = painted(texelFetch(objects, object * kTexels + 4), texelFetch(objects, object * kTexels + 5), d, at.depth,
                     normalize(normal), at.limb);
}
