// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: the operations of the Vector Math node that reflect, refract and project, and the Normal node's.

#include "nodes/bounded.glsl"

// a along b.
vec3 vector_project(vec3 a, vec3 b)
{
    vec3 along = unit_of(b);
    return bounded3(dot(a, along) * along);
}

vec3 vector_reflect(vec3 a, vec3 normal)
{
    vec3 n = unit_of(normal);
    return bounded3(a - 2.0 * dot(a, n) * n);
}

// 0 where all is reflected. eta: of the side where a comes from over the other one's.
vec3 vector_refract(vec3 a, vec3 normal, float eta)
{
    vec3 n = unit_of(normal);
    float cosine = dot(a, n), k = 1.0 - eta * eta * (1.0 - cosine * cosine);
    return k < 0.0 ? vec3(0.0) : bounded3(eta * a - (eta * cosine + sqrt(k)) * n);
}

vec3 vector_faceforward(vec3 a, vec3 incident, vec3 reference)
{
    return bounded(dot(reference, incident)) < 0.0 ? a : -a;
}

// The cosine between two directions.
float cosine_between(vec3 a, vec3 b)
{
    return dot(unit_of(a), unit_of(b));
}
