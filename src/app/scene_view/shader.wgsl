// Surfaces, strokes and marks. Places in the axes of the view have the eye in the origin and z towards it; the depth is −z.

struct Page {
    view_from_scene: mat4x4<f32>,
    // Clip x per view x (and depth), the same for y, depths of the near and the far plane.
    lens: vec4<f32>,
    // Width and height in pixels, pixels per pt, 1 for parallel projection.
    size: vec4<f32>,
    // How much nearer strokes and marks are taken to be than they are; pixels per unit at the depth of the target.
    strokes: vec4<f32>,
    // Ambient, head, fill, shine.
    light: vec4<f32>,
    // Direction to the second lamp.
    lamp: vec4<f32>,
};

@group(0) @binding(0) var<uniform> page: Page;

fn is_parallel() -> bool {
    return page.size.w > 0.5;
}

fn into_view(place: vec3<f32>) -> vec3<f32> {
    return (page.view_from_scene * vec4<f32>(place, 1.0)).xyz;
}

// From 0 on the near plane to 1 on the far one.
fn clip_depth(depth: f32) -> f32 {
    let near = page.lens.z;
    let far = page.lens.w;
    if (is_parallel()) {
        return (depth - near) / (far - near);
    }
    return far * (depth - near) / ((far - near) * depth);
}

// Pixels from the middle of the page, y up.
fn on_page(place: vec3<f32>) -> vec2<f32> {
    let across = select(place.xy / -place.z, place.xy, is_parallel());
    return across * page.lens.xy * page.size.xy * 0.5;
}

fn clip_from_page(at: vec2<f32>, depth: f32) -> vec4<f32> {
    let nearer = max(depth, page.lens.z);
    return vec4<f32>(at / (page.size.xy * 0.5), clip_depth(nearer), 1.0);
}

fn premultiplied(color: vec4<f32>) -> vec4<f32> {
    return vec4<f32>(color.rgb * color.a, color.a);
}

const NOWHERE: vec4<f32> = vec4<f32>(2.0, 2.0, 2.0, 1.0);

// ---- Surfaces

struct Facet {
    @builtin(position) clip: vec4<f32>,
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) front: vec4<f32>,
    @location(3) back: vec4<f32>,
};

@vertex
fn facet(
    @location(0) place: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) front: vec4<f32>,
    @location(3) back: vec4<f32>,
) -> Facet {
    let seen = into_view(place);
    let w = select(-seen.z, 1.0, is_parallel());
    var out: Facet;
    // Behind the eye w is not positive, and neither is the depth of clipping.
    let near = page.lens.z;
    let far = page.lens.w;
    let z = select(far, 1.0, is_parallel()) * (-seen.z - near) / (far - near);
    out.clip = vec4<f32>(seen.xy * page.lens.xy, z, w);
    out.place = seen;
    out.normal = (page.view_from_scene * vec4<f32>(normal, 0.0)).xyz;
    out.front = front;
    out.back = back;
    return out;
}

@fragment
fn lit(in: Facet, @builtin(front_facing) is_front: bool) -> @location(0) vec4<f32> {
    let color = select(in.back, in.front, is_front);
    let length_squared = dot(in.normal, in.normal);
    // Without a normal colours appear as they are.
    if (length_squared < 1e-12) {
        return premultiplied(color);
    }
    let normal = in.normal * (select(-1.0, 1.0, is_front) / sqrt(length_squared));
    let to_eye = select(normalize(-in.place), vec3<f32>(0.0, 0.0, 1.0), is_parallel());
    let facing = max(dot(normal, to_eye), 0.0);
    let light = page.light.x + page.light.y * facing + page.light.z * max(dot(normal, page.lamp.xyz), 0.0);
    let mirrored = max(dot(normal, normalize(page.lamp.xyz + to_eye)), 0.0);
    let m2 = mirrored * mirrored;
    let m4 = m2 * m2;
    let m8 = m4 * m4;
    let m16 = m8 * m8;
    let seen = clamp(color.rgb * light + page.light.w * m16 * m16, vec3<f32>(0.0), vec3<f32>(1.0));
    return premultiplied(vec4<f32>(seen, color.a));
}

// ---- Strokes: a segment with round ends, cut at bends along the bisector

struct Stroke {
    @builtin(position) clip: vec4<f32>,
    // Along the segment from its start, and across it, in pixels.
    @location(0) at: vec2<f32>,
    // Length of the segment, half the width, opacity, all the same at its four corners.
    @location(1) shape: vec3<f32>,
    @location(2) color: vec4<f32>,
    // Place in the pattern, dash, gap, in pixels.
    @location(3) dash: vec3<f32>,
};

// Each corner knows its own end, the other end, and the neighbour beyond its own end (its own end again if there is none).
// `style`: width in pt, length of the line so far, dash and gap in pt. `corner`: 1 or −1 for the left and right as seen
// towards the other end, twice that at the second end.
@vertex
fn stroke(
    @location(0) own: vec3<f32>,
    @location(1) other: vec3<f32>,
    @location(2) beyond: vec3<f32>,
    @location(3) color: vec4<f32>,
    @location(4) style: vec4<f32>,
    @location(5) corner: f32,
) -> Stroke {
    var out: Stroke;
    out.clip = NOWHERE;
    let near = page.lens.z;
    var a = into_view(own);
    var b = into_view(other);
    let room_a = -a.z - near;
    let room_b = -b.z - near;
    var is_cut = false;
    var run = 0.0;
    if (!is_parallel()) {
        if (room_a < 0.0 && room_b < 0.0) {
            return out;
        }
        if (room_a < 0.0) {
            run = room_a / (room_a - room_b);
            a = mix(a, b, run);
            is_cut = true;
        }
        if (room_b < 0.0) {
            b = mix(b, a, room_b / (room_b - room_a));
        }
    }
    let pixels = page.size.z;
    let width = style.x * pixels;
    let half_width = max(0.5 * width, 0.5);
    let reach = half_width + 1.0;
    let start = on_page(a);
    let stop = on_page(b);
    let span = distance(start, stop);
    let along = select(vec2<f32>(1.0, 0.0), (stop - start) / max(span, 1e-4), span > 1e-4);
    let left = vec2<f32>(-along.y, along.x);
    let side = sign(corner);
    var shift = left * (side * reach) - along * reach;
    let neighbour = into_view(beyond);
    if (!is_cut && any(own != beyond) && (is_parallel() || -neighbour.z >= near)) {
        let before = start - on_page(neighbour);
        let distance_before = sqrt(dot(before, before));
        if (distance_before > 1e-3 && span > 1e-3) {
            let left_before = vec2<f32>(-before.y, before.x) / distance_before;
            let middle = left + left_before;
            // Twice the square of the cosine of half the bend; sharper bends are rounded by overlapping.
            let flatness = 0.5 * dot(middle, middle);
            // The bisector must not run past the other end.
            if (flatness > 0.5 && span > reach * sqrt(max(2.0 / flatness - 1.0, 0.0))) {
                shift = middle * (side * reach / flatness);
            }
        }
    }
    let is_end = abs(corner) > 1.5;
    let x = dot(shift, along);
    let y = dot(shift, left);
    out.at = select(vec2<f32>(x, y), vec2<f32>(span - x, -y), is_end);
    out.shape = vec3<f32>(span, half_width, min(width, 1.0));
    out.color = color;
    let whole = distance(own, other) * run;
    let place = style.y + select(whole, -whole, is_end);
    out.dash = vec3<f32>(place * page.strokes.y, style.z * pixels, style.w * pixels);
    out.clip = clip_from_page(start + shift, -a.z - page.strokes.x);
    return out;
}

@fragment
fn inked(in: Stroke) -> @location(0) vec4<f32> {
    let past = max(max(-in.at.x, in.at.x - in.shape.x), 0.0);
    let away = sqrt(past * past + in.at.y * in.at.y);
    var opacity = clamp(in.shape.y + 0.5 - away, 0.0, 1.0) * in.shape.z;
    let step = max(fwidth(in.dash.x), 1e-4);
    let period = in.dash.y + in.dash.z;
    if (in.dash.y > 0.0 && in.dash.z > 0.0) {
        let phase = in.dash.x - period * floor(in.dash.x / period);
        // Distance into the dash that is nearest, negative in a gap.
        let inside = max(min(phase, in.dash.y - phase), phase - period);
        opacity *= clamp(inside / step + 0.5, 0.0, 1.0);
    }
    return premultiplied(vec4<f32>(in.color.rgb, in.color.a * opacity));
}

// ---- Marks

struct Mark {
    @builtin(position) clip: vec4<f32>,
    // From the centre in pixels, y up.
    @location(0) at: vec2<f32>,
    // Half the size, half the width of the outline, shape.
    @location(1) form: vec3<f32>,
    @location(2) fill: vec4<f32>,
    @location(3) outline: vec4<f32>,
};

// `form`: size and width of the outline in pt, number of the shape. `corner`: from (−1, −1) to (1, 1).
@vertex
fn mark(
    @location(0) place: vec3<f32>,
    @location(1) fill: vec4<f32>,
    @location(2) outline: vec4<f32>,
    @location(3) form: vec3<f32>,
    @location(4) corner: vec2<f32>,
) -> Mark {
    var out: Mark;
    out.clip = NOWHERE;
    let seen = into_view(place);
    if (!is_parallel() && -seen.z <= page.lens.z * 0.999) {
        return out;
    }
    let half_size = 0.5 * form.x * page.size.z;
    let half_outline = 0.5 * form.y * page.size.z;
    // Tips of diamonds reach √2 times as far, those of strokes half a width more.
    let shift = corner * (1.4143 * half_size + half_outline + 1.0);
    let unit = page.lens.y * page.size.y * 0.5 / select(-seen.z, 1.0, is_parallel());
    out.at = shift;
    out.form = vec3<f32>(half_size, half_outline, form.z);
    out.fill = fill;
    out.outline = outline;
    // As near as a ball of this size.
    out.clip = clip_from_page(on_page(seen) + shift, -seen.z - page.strokes.x - half_size / unit);
    return out;
}

fn rod(at: vec2<f32>, reach: f32) -> f32 {
    return length(vec2<f32>(max(abs(at.x) - reach, 0.0), at.y));
}

@fragment
fn stamped(in: Mark) -> @location(0) vec4<f32> {
    let p = in.at;
    let size = in.form.x;
    // The square turned by an eighth.
    let turned = vec2<f32>(p.x + p.y, p.x - p.y) * 0.70710678;
    var away = length(p) - size;
    if (in.form.z > 3.5) {
        let ink = clamp(in.form.y + 0.5 - min(rod(turned, 1.4142 * size), rod(turned.yx, 1.4142 * size)), 0.0, 1.0);
        return premultiplied(vec4<f32>(in.outline.rgb, in.outline.a * ink));
    } else if (in.form.z > 2.5) {
        away = max(0.8660254 * abs(p.x) + 0.5 * p.y, -p.y) - 0.5 * size;
    } else if (in.form.z > 1.5) {
        away = max(abs(turned.x), abs(turned.y)) - size;
    } else if (in.form.z > 0.5) {
        away = max(abs(p.x), abs(p.y)) - size;
    }
    let fill = premultiplied(vec4<f32>(in.fill.rgb, in.fill.a * clamp(0.5 - away, 0.0, 1.0)));
    let rim = clamp(in.form.y + 0.5 - abs(away), 0.0, 1.0) * min(2.0 * in.form.y, 1.0);
    let outline = premultiplied(vec4<f32>(in.outline.rgb, in.outline.a * rim));
    return outline + fill * (1.0 - outline.a);
}
