// Where a ray enters a solid. Variants: PLANES (bounding planes), GENERAL (the quadric need not be an ellipsoid).

struct Entry {
    float depth;
    int surface;
    float limb;  // the limb function g (image model)
};

// Discards the fragment where the ray does not enter, or no further away than `near`. The quadric's equation is set up
// about the ray's point nearest to the anchor, so that single precision is enough for small objects far away.
Entry enter(Solid s, vec3 d) {
    float k0 = dot(s.anchor, d) / dot(d, d);
    vec3 q = k0 * d - s.anchor, md = s.m * d;
    float a = dot(d, md), b = dot(q, md) + dot(s.w, d), c = dot(q, s.m * q) + 2.0 * dot(s.w, q) + s.c;
    float discriminant = b * b - a * c;
    Entry at = Entry(0.0, 0, 1.0);
#ifdef GENERAL
    const float far = 1e30;
    vec2 before = vec2(-far, far), behind = vec2(far, -far);  // the stretches with Q < 0, relative to k0
    if (discriminant > 0.0) {
        if (a == 0.0) a = 1e-30;
        float h = b + (b < 0.0 ? -1.0 : 1.0) * sqrt(discriminant);
        float r0 = clamp(-h / a, -far, far), r1 = clamp(-c / h, -far, far);
        before = vec2(min(r0, r1), max(r0, r1));
        if (a < 0.0) {
            behind = vec2(before.y, far);
            before = vec2(-far, before.x);
        }
    } else if (a > 0.0 || c >= 0.0)
        discard;
    if (s.centre_value > 0.0 && a > 0.0) at.limb = clamp(discriminant / (a * s.centre_value), 0.0, 1.0);
#else
    if (discriminant <= 0.0) discard;
    float root = sqrt(discriminant);
    vec2 before = vec2(-b - root, -b + root) / a;
    at.limb = clamp(discriminant / (a * s.centre_value), 0.0, 1.0);
#endif
#ifdef PLANES
    float from = -1e30, to = 1e30;
    int face = 0;
    for (int i = 0; i < s.plane_count; ++i) {
        vec4 plane = texelFetch(planes, s.first_plane + i);  // at the eye
        float along = dot(plane.xyz, d), level = -plane.w / along - k0;
        if (along == 0.0)
            to = plane.w > 0.0 ? to : -1e30;
        else if (along < 0.0)
            to = min(to, level);
        else if (level > from) {
            from = level;
            face = i + 1;
        }
    }
#ifdef GENERAL
    bool first = min(before.y, to) > max(before.x, from) && k0 + min(before.y, to) > 0.0;
    vec2 inside = first ? before : behind;
#else
    vec2 inside = before;
#endif
    if (from > inside.x) at.surface = face;
    inside = vec2(max(inside.x, from), min(inside.y, to));
    if (inside.y <= inside.x) discard;
    at.depth = k0 + inside.x;
#else
#ifdef GENERAL
    at.depth = k0 + (k0 + before.y > 0.0 ? before.x : behind.x);
#else
    at.depth = k0 + before.x;
#endif
#endif
    if (!(at.depth > near) || at.depth > 1e29) discard;
    if (at.surface != 0) at.limb = 1.0;
    return at;
}
