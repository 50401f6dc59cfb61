#version 300 es
// The sphere of `abrdf preview`: the same camera, interpolation, light and colours.
precision highp float;
precision highp sampler2DArray;
precision highp sampler3D;

const float PI = 3.14159265358979;
const int MOST_RINGS = 16;

uniform vec2 uSize;               // Pixels.
uniform mat3 uCamera;             // Columns: right, up, towards the camera.
uniform float uDistance;          // From the middle of the sphere.
uniform float uHalfAngle;         // Tangent of half the field of view.
uniform vec3 uLight;              // Unit vector towards the one light or the sun.
uniform vec3 uStrength;           // What a white Lambertian that faces it shows; 0: no such light.
uniform float uTurn;              // Of the environment about the axis, in turns.
uniform bool uEnvironment;
uniform float uExposure;
uniform float uTone;              // 0: plain sRGB, 1: the view of the colour config.
uniform float uWipe;              // Left of it, as a share of the width, is the measurement.
uniform bool uShowDifference;
uniform bool uHasReconstruction;
uniform bool uHasMeasurement;
uniform vec3 uBackground;

// Two tables: 0 the reconstruction, 1 the measurement. Columns are views, rows lights; alpha is
// 1 / p, the profile at the pair.
uniform sampler2D uTable0;
uniform sampler2D uTable1;
// The environment, gathered at nodes of longitude and latitude: one layer a light direction.
uniform sampler2DArray uGathered0;
uniform sampler2DArray uGathered1;
// theta, phi0, count, first; lights and views of table 0, then of table 1.
uniform vec4 uRings[4 * MOST_RINGS];
uniform ivec4 uRingCounts;
uniform ivec2 uLightCounts;
uniform bvec2 uCosineInside;
// Coefficients of the splines of ln p over ln(half angle + 2 degrees): LobeProfile of the program.
const int PLACES = 32;
uniform float uLobes[2 * PLACES];
uniform sampler3D uView;

out vec4 outColor;

struct Weights {
    ivec4 index;
    vec4 weight;
};

void ringPlace(vec4 ring, float phi, out ivec2 index, out vec2 weight) {
    float count = ring.z;
    float place = fract((phi - ring.y) / (2.0 * PI)) * count;
    float before = min(floor(place), count - 1.0);
    float t = place - before;
    index = ivec2(ring.w + before, ring.w + mod(before + 1.0, count));
    weight = vec2(1.0 - t, t);
}

// Linear in theta between two rings, linear and periodic in phi along each.
Weights weightsOf(int set, vec3 direction) {
    int first = set * MOST_RINGS;
    int count = uRingCounts[set];
    float theta = atan(length(direction.xy), direction.z);
    float phi = length(direction.xy) > 0.0 ? atan(direction.y, direction.x) : 0.0;
    int above = 0;
    while (above < count && uRings[first + above].x < theta) ++above;
    int lower = clamp(above - 1, 0, count - 1);
    int upper = clamp(above, 0, count - 1);
    float gap = uRings[first + upper].x - uRings[first + lower].x;
    float t = gap > 0.0 ? (theta - uRings[first + lower].x) / gap : 0.0;
    Weights w;
    ivec2 index;
    vec2 weight;
    ringPlace(uRings[first + lower], phi, index, weight);
    w.index.xy = index;
    w.weight.xy = weight * (1.0 - t);
    ringPlace(uRings[first + upper], phi, index, weight);
    w.index.zw = index;
    w.weight.zw = weight * t;
    return w;
}

vec4 stored(int table, int light, int view) {
    return table == 0 ? texelFetch(uTable0, ivec2(view, light), 0)
                      : texelFetch(uTable1, ivec2(view, light), 0);
}

vec3 row(int table, int light, Weights views) {
    vec3 sum = vec3(0.0);
    for (int v = 0; v < 4; ++v) {
        if (views.weight[v] > 0.0) sum += views.weight[v] * stored(table, light, views.index[v]).rgb;
    }
    return sum;
}

// The same as ratios to the profile.
vec3 ratioRow(int table, int light, Weights views) {
    vec3 sum = vec3(0.0);
    for (int v = 0; v < 4; ++v) {
        vec4 value = stored(table, light, views.index[v]);
        sum += views.weight[v] * value.a * value.rgb;
    }
    return sum;
}

float lobe(int table, vec3 halfVector) {
    float degrees = clamp(atan(length(halfVector.xy), halfVector.z) * 180.0 / PI, 0.0, 90.0);
    float place = log((degrees + 2.0) / 2.0) / log(46.0) * float(PLACES - 1);
    int i = min(int(place), PLACES - 2);
    float t = place - float(i), u = 1.0 - t;
    int first = table * PLACES;
    float sum = u * u * u * uLobes[first + (i > 0 ? i - 1 : 1)]
        + (3.0 * t * t * t - 6.0 * t * t + 4.0) * uLobes[first + i]
        + (3.0 * u * u * u - 6.0 * u * u + 4.0) * uLobes[first + i + 1]
        + t * t * t * uLobes[first + min(i + 2, PLACES - 1)];
    return exp(sum / 6.0);
}

// What values past the last elevation, or without their cosine, are multiplied by.
float lightFactor(int table, float cosine) {
    if (!uCosineInside[table]) return cosine;
    int set = 2 * table;
    float last = cos(uRings[set * MOST_RINGS + uRingCounts[set] - 1].x);
    return cosine < last ? cosine / last : 1.0;
}

vec3 gathered(int table, vec2 place, int light) {
    return table == 0 ? texture(uGathered0, vec3(place, light)).rgb
                      : texture(uGathered1, vec3(place, light)).rgb;
}

vec3 radiance(int table, vec3 normal, vec3 towards) {
    float longitude = atan(normal.x, normal.z);
    vec3 x = vec3(cos(longitude), 0.0, -sin(longitude));
    mat3 frame = mat3(x, cross(normal, x), normal);
    Weights views = weightsOf(2 * table + 1, towards * frame);
    vec3 sum = vec3(0.0);
    vec3 light = uLight * frame;
    if (uStrength.g > 0.0 && light.z > 0.0) {
        Weights lights = weightsOf(2 * table, light);
        for (int l = 0; l < 4; ++l) {
            if (lights.weight[l] > 0.0) sum += lights.weight[l] * ratioRow(table, lights.index[l], views);
        }
        sum *= uStrength * lightFactor(table, light.z) * lobe(table, light + towards * frame);
    }
    if (uEnvironment) {
        // The first and the last column are one meridian; nodes are the middles of texels.
        vec2 nodes = vec2(table == 0 ? textureSize(uGathered0, 0).xy : textureSize(uGathered1, 0).xy);
        float u = fract(longitude / (2.0 * PI) + 0.5 - uTurn);
        float v = acos(clamp(normal.y, -1.0, 1.0)) / PI;
        vec2 place = (vec2(u, v) * (nodes - 1.0) + 0.5) / nodes;
        for (int l = 0; l < uLightCounts[table]; ++l) {
            vec3 strength = gathered(table, place, l);
            if (strength.r + strength.g + strength.b > 0.0) sum += strength * row(table, l, views);
        }
    }
    return sum;
}

vec3 srgb(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

vec3 shown(vec3 linear) {
    vec3 plain = srgb(linear);
    if (uTone <= 0.0) return plain;
    float side = float(textureSize(uView, 0).x);
    vec3 place = clamp(log2(1.0 + 1024.0 * max(linear, 0.0)) / 16.0, 0.0, 1.0);
    return mix(plain, texture(uView, (place * (side - 1.0) + 0.5) / side).rgb, uTone);
}

vec3 lab(vec3 linear) {
    vec3 c = clamp(linear, 0.0, 1.0);
    mat3 toXyz = mat3(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505);
    vec3 t = (toXyz * c) / (toXyz * vec3(1.0));
    vec3 f = mix(t * 7.787037 + 4.0 / 29.0, pow(max(t, 1e-9), vec3(1.0 / 3.0)), step(0.008856452, t));
    return vec3(116.0 * f.y - 16.0, 500.0 * (f.x - f.y), 200.0 * (f.y - f.z));
}

// Near black over violet, red and yellow to cream, as in the sheets.
vec3 heat(float x) {
    float t = clamp(x, 0.0, 1.0);
    vec3 c = vec3(-8.648, 8.620, 15.508);
    c = c * t + vec3(28.219, -27.263, -36.911);
    c = c * t + vec3(-32.053, 28.708, 37.292);
    c = c * t + vec3(13.376, -10.343, -19.472);
    c = c * t + vec3(0.103, 1.143, 4.197);
    return clamp(c * t + vec3(-0.002, 0.050, 0.168), 0.0, 1.0);
}

void main() {
    vec2 place = (2.0 * gl_FragCoord.xy / uSize - 1.0) * uHalfAngle * uSize / min(uSize.x, uSize.y);
    vec3 origin = uCamera[2] * uDistance;
    vec3 direction = normalize(uCamera * vec3(place, -1.0));
    float along = dot(origin, direction);
    float nearest = sqrt(max(uDistance * uDistance - along * along, 0.0));
    float cover = clamp(0.5 + (1.0 - nearest) / max(fwidth(nearest), 1e-6), 0.0, 1.0);
    if (cover <= 0.0) {
        outColor = vec4(shown(uBackground), 1.0);
        return;
    }
    vec3 hit = origin + direction * (-along - sqrt(max(1.0 - nearest * nearest, 0.0)));
    vec3 normal = normalize(hit);
    bool left = gl_FragCoord.x < uWipe * uSize.x;
    if (uShowDifference && uHasMeasurement && uHasReconstruction) {
        vec3 a = lab(uExposure * radiance(0, normal, -direction));
        vec3 b = lab(uExposure * radiance(1, normal, -direction));
        outColor = vec4(mix(shown(uBackground), heat(distance(a, b) / 20.0), cover), 1.0);
        return;
    }
    int table = uHasMeasurement && (left || !uHasReconstruction) ? 1 : 0;
    vec3 color = uExposure * radiance(table, normal, -direction);
    outColor = vec4(shown(mix(uBackground, color, cover)), 1.0);
}
