// What every shader of a frame shares. Eye axes: x right, y forward, z up; a pixel looks along d = (x, 1, z), so that a
// ray's parameter is depth.

layout(std140) uniform Frame {
    vec4 window;          // x, z of d at the lower left corner; steps to the right and up
    mat4 scene_from_eye;  // rotation
    vec4 to_sun;          // eye axes; ambient
    vec4 up;              // eye axes; height of the eye above the ground
    vec4 horizon;         // colour; extinction in octaves per metre
    vec4 zenith;
    vec4 haze;
};
const float near = 0.1;

vec3 ray(vec2 pixel) { return vec3(window.x + pixel.x * window.z, 1.0, window.y + pixel.y * window.w); }

// Objects, kTexels each: see object_record.h.
uniform samplerBuffer objects;
uniform samplerBuffer planes;
const int kTexels = 8;
const int kPlaneWithoutEnd = 31;  // surface of the ground and of cloud decks

struct Solid {
    vec3 anchor;
    float c;
    mat3 m;
    float centre_value;
    vec3 w;
    int first_plane, plane_count;
};

Solid read_solid(int object) {
    vec4 a = texelFetch(objects, object * kTexels), b = texelFetch(objects, object * kTexels + 1);
    vec4 e = texelFetch(objects, object * kTexels + 2), f = texelFetch(objects, object * kTexels + 3);
    return Solid(a.xyz, a.w, mat3(b.x, e.x, e.y, e.x, b.y, e.z, e.y, e.z, b.z), b.w, f.xyz, int(e.w), int(f.w));
}
