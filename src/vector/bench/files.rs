//! The expectation files of each bench, by name: their descriptions, or the tables of their rows.

use crate::vector::table::Table;

/// Tables of expectations.
pub trait Answers: Send {
    /// The tables in file order, which is that of the bench's descriptions.
    fn tables(&mut self) -> Vec<&mut Table>;
}

/// One file: a walk's, or that of the set-up.
#[derive(Clone, Debug)]
pub struct Single<T> {
    /// `dda.exp`, `edge.exp` or `setup.exp`.
    pub exp: T,
}

/// The files of the `triangle` bench.
#[derive(Clone, Debug)]
pub struct TriangleAnswers<T> {
    /// `triangle.exp`: counts of each triangle.
    pub exp: T,
    /// `span.exp`: runs of covered samples.
    pub spans: T,
    /// `depth.exp`: depths of covered samples, if there is depth.
    pub depths: Option<T>,
    /// `mask.exp`: masks of covered pixels, if pixels have several samples.
    pub masks: Option<T>,
}

/// The files of a bench of lines, points, quadrilaterals or homogeneous triangles.
#[derive(Clone, Debug)]
pub struct ShapeAnswers<T> {
    /// Runs of covered samples.
    pub spans: T,
    /// Depths of covered samples, if there is depth.
    pub depths: Option<T>,
}

/// The files of the `channel` bench.
#[derive(Clone, Debug)]
pub struct ChannelAnswers<T> {
    /// Set-up words of each triangle.
    pub setup: T,
    /// Codes at covered samples, a file for each channel.
    pub codes: Vec<T>,
    /// Differences and levels at covered pixels, a file for each channel with a level of detail.
    pub details: Vec<T>,
}

/// The files of a machine that begins at registers.
#[derive(Clone, Debug)]
pub struct RegisterAnswers<T> {
    /// One for each kind of record, in the order of the machine.
    pub records: Vec<T>,
}

impl<T> Single<T> {
    /// The files in order.
    pub fn list(&self) -> Vec<&T> {
        vec![&self.exp]
    }

    /// The same with something made of each file.
    pub fn map<U>(&self, make: impl Fn(&T) -> U) -> Single<U> {
        Single { exp: make(&self.exp) }
    }
}

impl<T> TriangleAnswers<T> {
    /// The files in order.
    pub fn list(&self) -> Vec<&T> {
        [&self.exp, &self.spans].into_iter().chain(&self.depths).chain(&self.masks).collect()
    }

    /// The same with something made of each file.
    pub fn map<U>(&self, make: impl Fn(&T) -> U) -> TriangleAnswers<U> {
        TriangleAnswers {
            exp: make(&self.exp),
            spans: make(&self.spans),
            depths: self.depths.as_ref().map(&make),
            masks: self.masks.as_ref().map(&make),
        }
    }
}

impl<T> ShapeAnswers<T> {
    /// The files in order.
    pub fn list(&self) -> Vec<&T> {
        std::iter::once(&self.spans).chain(&self.depths).collect()
    }

    /// The same with something made of each file.
    pub fn map<U>(&self, make: impl Fn(&T) -> U) -> ShapeAnswers<U> {
        ShapeAnswers { spans: make(&self.spans), depths: self.depths.as_ref().map(&make) }
    }
}

impl<T> ChannelAnswers<T> {
    /// The files in order.
    pub fn list(&self) -> Vec<&T> {
        std::iter::once(&self.setup).chain(&self.codes).chain(&self.details).collect()
    }

    /// The same with something made of each file.
    pub fn map<U>(&self, make: impl Fn(&T) -> U) -> ChannelAnswers<U> {
        ChannelAnswers {
            setup: make(&self.setup),
            codes: self.codes.iter().map(&make).collect(),
            details: self.details.iter().map(&make).collect(),
        }
    }
}

impl Answers for ChannelAnswers<Table> {
    fn tables(&mut self) -> Vec<&mut Table> {
        std::iter::once(&mut self.setup).chain(&mut self.codes).chain(&mut self.details).collect()
    }
}

impl<T> RegisterAnswers<T> {
    /// The files in order.
    pub fn list(&self) -> Vec<&T> {
        self.records.iter().collect()
    }

    /// The same with something made of each file.
    pub fn map<U>(&self, make: impl Fn(&T) -> U) -> RegisterAnswers<U> {
        RegisterAnswers { records: self.records.iter().map(make).collect() }
    }
}

impl Answers for Single<Table> {
    fn tables(&mut self) -> Vec<&mut Table> {
        vec![&mut self.exp]
    }
}

impl Answers for TriangleAnswers<Table> {
    fn tables(&mut self) -> Vec<&mut Table> {
        let always = [&mut self.exp, &mut self.spans].into_iter();
        always.chain(&mut self.depths).chain(&mut self.masks).collect()
    }
}

impl Answers for ShapeAnswers<Table> {
    fn tables(&mut self) -> Vec<&mut Table> {
        std::iter::once(&mut self.spans).chain(&mut self.depths).collect()
    }
}

impl Answers for RegisterAnswers<Table> {
    fn tables(&mut self) -> Vec<&mut Table> {
        self.records.iter_mut().collect()
    }
}
