//! Colours and line strengths of the looks: light, dark, presentation.
//!
//! The palette starts from the colours of M. Okabe and K. Ito (*Color Universal Design*, 2008), made darker or lighter
//! until each stands out from its ground with a contrast of at least 3 : 1 ([`contrast`]).

use crate::figure::picture::{Color, Stroke};
use crate::figure::scene::Light;

/// One look of every figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    /// Name as shown to people, in lower case.
    pub name: &'static str,
    /// Whether the ground is dark.
    pub is_dark: bool,
    /// Ground of canvas and page.
    pub background: Color,
    /// Ground of boxes that stand on the canvas: legends, labels.
    pub panel: Color,
    /// Text.
    pub text: Color,
    /// Text of less weight: ticks, hints.
    pub muted_text: Color,
    /// Fine grid lines.
    pub grid: Color,
    /// Every fifth or tenth grid line.
    pub grid_major: Color,
    /// Axes of coordinates and frames.
    pub axis: Color,
    /// Control polygons and nets.
    pub polygon: Color,
    /// Curvature combs and other quantities drawn beside a curve.
    pub comb: Color,
    /// What is selected or under the pointer.
    pub selection: Color,
    /// The parameter and the construction that belongs to it.
    pub accent: Color,
    /// Something to look at.
    pub warning: Color,
    /// Something wrong.
    pub error: Color,
    /// Front of surfaces that have no colour of their own.
    pub surface: Color,
    /// Back of such surfaces.
    pub surface_back: Color,
    /// Lines that run within surfaces: parameter lines, edges of facets.
    pub surface_line: Color,
    /// Light of scenes.
    pub light: Light,
    /// Colours of curves and B-splines, each with a contrast of at least 3 : 1 against `background`.
    pub palette: [Color; 8],
    /// Factor for all line widths and markers.
    pub stroke_scale: f64,
    /// Factor for all type sizes.
    pub text_scale: f64,
}

impl Theme {
    /// Dark ink on a light ground.
    pub const fn light() -> Self {
        Self {
            name: "light",
            is_dark: false,
            background: Color::hex(0xFD_FD_FB),
            panel: Color::hex(0xF2_F2_EE),
            text: Color::hex(0x1D_20_24),
            muted_text: Color::hex(0x5E_64_6C),
            grid: Color::hex(0xEC_EC_E8),
            grid_major: Color::hex(0xD9_D9_D4),
            axis: Color::hex(0x7E_83_8A),
            polygon: Color::hex(0x7B_83_8D),
            comb: Color::hex(0x7E_55_A8),
            selection: Color::hex(0xC2_41_0C),
            accent: Color::hex(0xB0_1E_5B),
            warning: Color::hex(0x8F_5F_00),
            error: Color::hex(0xB4_23_18),
            surface: Color::hex(0x8F_B8_DE),
            surface_back: Color::hex(0xE0_BC_8A),
            surface_line: Color::hex(0x24_3B_53),
            light: Light { ambient: 0.42, head: 0.46, fill: 0.22, shine: 0.12 },
            palette: [
                Color::hex(0x00_6B_AE),
                Color::hex(0xCB_57_00),
                Color::hex(0x00_89_62),
                Color::hex(0xB8_4E_8C),
                Color::hex(0x9C_71_00),
                Color::hex(0x2B_8C_CF),
                Color::hex(0x6B_6A_00),
                Color::hex(0x4A_4A_4A),
            ],
            stroke_scale: 1.0,
            text_scale: 1.0,
        }
    }

    /// Light ink on a dark ground.
    pub const fn dark() -> Self {
        Self {
            name: "dark",
            is_dark: true,
            background: Color::hex(0x17_19_1D),
            panel: Color::hex(0x22_25_2A),
            text: Color::hex(0xE9_EA_EC),
            muted_text: Color::hex(0x9E_A5_AE),
            grid: Color::hex(0x23_26_2B),
            grid_major: Color::hex(0x32_36_3D),
            axis: Color::hex(0x6F_76_80),
            polygon: Color::hex(0x8B_93_9E),
            comb: Color::hex(0xB7_92_E0),
            selection: Color::hex(0xFF_9D_5C),
            accent: Color::hex(0xFF_7F_B0),
            warning: Color::hex(0xE3_B3_41),
            error: Color::hex(0xFF_7B_6E),
            surface: Color::hex(0x3F_74_A6),
            surface_back: Color::hex(0xA0_73_38),
            surface_line: Color::hex(0xDC_E9_F5),
            light: Light { ambient: 0.35, head: 0.45, fill: 0.25, shine: 0.18 },
            palette: [
                Color::hex(0x56_B4_E9),
                Color::hex(0xF0_7F_2E),
                Color::hex(0x1F_BF_91),
                Color::hex(0xDB_8A_BA),
                Color::hex(0xE6_9F_00),
                Color::hex(0x4F_8F_E6),
                Color::hex(0xF0_E4_42),
                Color::hex(0xC4_C8_CE),
            ],
            stroke_scale: 1.0,
            text_scale: 1.0,
        }
    }

    /// The light look with pure white ground, stronger lines and larger type, for a projector.
    pub const fn presentation() -> Self {
        Self {
            name: "presentation",
            background: Color::hex(0xFF_FF_FF),
            panel: Color::hex(0xF4_F4_F2),
            text: Color::hex(0x00_00_00),
            muted_text: Color::hex(0x45_4A_50),
            grid_major: Color::hex(0xCD_CD_C8),
            axis: Color::hex(0x6B_70_77),
            polygon: Color::hex(0x5F_66_6F),
            stroke_scale: 1.75,
            text_scale: 1.4,
            ..Self::light()
        }
    }

    /// All looks, in the order of the menu.
    pub const fn all() -> [Self; 3] {
        [Self::light(), Self::dark(), Self::presentation()]
    }

    /// The look with this [`Self::name`].
    pub fn by_name(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|theme| theme.name == name)
    }

    /// Colour of B-spline, control point or series number `k`; repeats after the palette's length.
    pub fn basis_color(&self, k: usize) -> Color {
        self.palette[k % self.palette.len()]
    }

    /// The colour of surface `k`: that of curve `k`, nearer to the ground so that lines within the surface stand out.
    pub fn surface_color(&self, k: usize) -> Color {
        self.basis_color(k).mixed(self.background, 0.3)
    }

    /// A solid line `width` pt wide before [`Self::stroke_scale`].
    pub fn stroke(&self, color: Color, width: f64) -> Stroke {
        Stroke::solid(color, width * self.stroke_scale)
    }

    /// A dashed line; all lengths in pt before [`Self::stroke_scale`].
    pub fn dashed_stroke(&self, color: Color, width: f64, dash: f64, gap: f64) -> Stroke {
        let scale = self.stroke_scale;
        Stroke::dashed(color, width * scale, dash * scale, gap * scale)
    }
}

/// Contrast of two opaque colours, between 1 and 21, as the Web Content Accessibility Guidelines 2.1 define it:
/// `(L + 0.05)/(L′ + 0.05)` of the relative luminances, the larger above.
pub fn contrast(a: Color, b: Color) -> f64 {
    let (a, b) = (relative_luminance(a), relative_luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

fn relative_luminance(color: Color) -> f64 {
    let [red, green, blue] = linear_rgb(color);
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

fn linear_rgb(color: Color) -> [f64; 3] {
    [color.r, color.g, color.b].map(|byte| {
        let value = f64::from(byte) / 255.0;
        if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_on_white_has_the_largest_contrast() {
        let largest = contrast(Color::hex(0), Color::hex(0xFF_FF_FF));
        assert!((largest - 21.0).abs() < 1e-12, "{largest}");
        let none = contrast(Color::hex(0x12_34_56), Color::hex(0x12_34_56));
        assert!((none - 1.0).abs() < 1e-15, "{none}");
    }

    #[test]
    fn every_ink_stands_out_from_its_ground() {
        for theme in Theme::all() {
            for (k, &color) in theme.palette.iter().enumerate() {
                let found = contrast(color, theme.background);
                assert!(found >= 3.0_f64, "{} palette {k} {color:?}: {found:.2}", theme.name);
            }
            let inks = [
                ("text", theme.text, 7.0_f64),
                ("muted_text", theme.muted_text, 4.5),
                ("axis", theme.axis, 3.0),
                ("polygon", theme.polygon, 3.0),
                ("comb", theme.comb, 3.0),
                ("selection", theme.selection, 4.5),
                ("accent", theme.accent, 4.5),
                ("warning", theme.warning, 4.5),
                ("error", theme.error, 4.5),
            ];
            for (ink, color, least) in inks {
                for ground in [theme.background, theme.panel] {
                    let found = contrast(color, ground);
                    assert!(found >= least, "{} {ink} on {ground:?}: {found:.2}", theme.name);
                }
            }
        }
    }

    /// Neighbours in the palette stand side by side in every plot of B-splines. The colours as people without green cones
    /// see them after F. Viénot, H. Brettel and J. Mollon, 1999, in linear light.
    #[test]
    fn neighbours_differ_without_green_cones() {
        let seen = |color: Color| {
            let [red, green, blue] = linear_rgb(color);
            [0.29275 * red + 0.70725 * green, -0.02234 * red + 0.02234 * green + blue].map(f64::cbrt)
        };
        for theme in Theme::all() {
            for k in 0..theme.palette.len() {
                let (a, b) = (seen(theme.basis_color(k)), seen(theme.basis_color(k + 1)));
                let distance = (a[0] - b[0]).hypot(a[1] - b[1]);
                assert!(distance > 0.1, "{} palette {k} and the next: {distance:.3}", theme.name);
            }
        }
    }

    #[test]
    fn basis_colours_repeat_after_the_palette() {
        let theme = Theme::light();
        assert_eq!(theme.basis_color(8), theme.basis_color(0), "8 colours");
        assert_ne!(theme.basis_color(7), theme.basis_color(0), "8 colours");
    }
}
