//! The samples of the curve that was charted last: they are needed in every frame and seldom change.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use crate::document::Object;
use crate::figure::curve_chart::CurveSamples;

/// Keeps the last samples with the object that they are of.
#[derive(Debug, Default)]
pub struct ChartCache(RefCell<Option<(Arc<Object>, Rc<CurveSamples>)>>);

impl ChartCache {
    /// The samples of a curve; `None` for other objects.
    pub(crate) fn samples(&self, object: &Arc<Object>) -> Option<Rc<CurveSamples>> {
        let mut last = self.0.borrow_mut();
        if let Some((known, samples)) = last.as_ref()
            && Arc::ptr_eq(known, object)
        {
            return Some(Rc::clone(samples));
        }
        let samples = Rc::new(CurveSamples::new(object.curve()?));
        *last = Some((Arc::clone(object), Rc::clone(&samples)));
        Some(samples)
    }
}
