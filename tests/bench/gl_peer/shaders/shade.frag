// Colours of what is seen: sky, ground and opaque objects, once a pixel.
uniform usampler2D seen;
layout(location = 0) out vec4 colour;

void main() {
    vec3 d = ray(gl_FragCoord.xy);
    uvec2 there = texelFetch(seen, ivec2(gl_FragCoord.xy), 0).xy;
    float u = uintBitsToFloat(there.y);
    int object = int(there.x >> 5u), surface = int(there.x & 31u);
    vec4 paint = texelFetch(objects, object * kTexels + 4), texture_holes = texelFetch(objects, object * kTexels + 5);
    bool sky = u == 0.0;
    if (sky) texture_holes.x = -1.0;
    float k = sky ? 1.0 : 1.0 / u;
    vec3 normal = up.xyz;
    if (surface != kPlaneWithoutEnd && !sky) {
        Solid s = read_solid(object);
        normal = surface == 0 ? s.m * (k * d - s.anchor) + s.w
                              : -texelFetch(planes, s.first_plane + surface - 1).xyz;
        normal = normalize(normal);
    }
    vec3 shaded = painted(paint, texture_holes, d, k, normal, 1.0).rgb;
    float elevation = clamp((mat3(scene_from_eye) * d).z / length(d), 0.0, 1.0);
    if (sky) shaded = mix(horizon.rgb, zenith.rgb, elevation);
#ifdef LAST
    shaded = encoded(shaded);
#endif
    colour = vec4(shaded, 1.0);
}
