use rand_pcg::Pcg32;
use rand_pcg::rand_core::{Rng, SeedableRng};
use serde::{Deserialize, Serialize};

use super::{Axis, AxisError, Evaluated, Record, Search};

/// Settings of a genetic search; the defaults are those of Andreis (2017, Tables 4.7 and 4.8).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct GeneticSettings {
    /// Individuals, 4 at least.
    pub population: usize,
    /// Generations, the first included.
    pub generations: usize,
    /// The best ones that live on as they are.
    pub elite: usize,
    /// Share of the others that are made by crossover, 0 to 1; mutation makes the rest.
    pub crossover: f64,
    /// Seed.
    pub seed: u32,
}

impl Default for GeneticSettings {
    fn default() -> Self {
        Self { population: 25, generations: 100, elite: 3, crossover: 0.8, seed: 1 }
    }
}

/// A genetic search in a box: a random population, selection by rank, an elite, intermediate crossover, and mutation that becomes
/// smaller with the generations (Andreis 2017, §2.6.2). A seed gives the same search everywhere.
#[derive(Clone, Debug)]
pub struct Genetic<const N: usize> {
    record: Record<N>,
    settings: GeneticSettings,
    random: Pcg32,
    /// Individuals in shares of the axes, and the costs of those that were evaluated.
    population: Vec<[f64; N]>,
    costs: Vec<f64>,
    generation: usize,
}

/// Spread of the first mutations as a share of an axis, and by how much it is less in the last generation.
const SPREAD: f64 = 0.3;
const COOLING: f64 = 0.99;

impl<const N: usize> Genetic<N> {
    /// A search. Fewer than 4 individuals or 1 generation count as so many, more elite than half of the population as half.
    ///
    /// # Errors
    /// [`AxisError`] for a box that cannot be searched.
    pub fn new(axes: [Axis; N], settings: GeneticSettings) -> Result<Self, AxisError> {
        let population = settings.population.clamp(4, 1_000);
        let settings = GeneticSettings {
            population,
            generations: settings.generations.max(1),
            elite: settings.elite.min(population / 2),
            crossover: settings.crossover.clamp(0.0, 1.0),
            ..settings
        };
        let mut search = Self {
            record: Record::new(axes)?,
            settings,
            random: Pcg32::seed_from_u64(u64::from(settings.seed)),
            population: Vec::with_capacity(population),
            costs: Vec::with_capacity(population),
            generation: 0,
        };
        for _ in 0..population {
            let individual = std::array::from_fn(|_| search.uniform());
            search.population.push(individual);
        }
        Ok(search)
    }

    /// The present population, evaluated or not.
    pub fn population(&self) -> impl Iterator<Item = [f64; N]> + '_ {
        self.population.iter().map(|shares| self.record.point(shares))
    }

    /// Number of the present generation, from 0.
    pub fn generation(&self) -> usize {
        self.generation
    }

    /// From 0 to below 1.
    fn uniform(&mut self) -> f64 {
        f64::from(self.random.next_u32()) / (f64::from(u32::MAX) + 1.0)
    }

    /// About normal with unit variance: the sum of twelve uniform deviates, without a function in which platforms differ.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }

    /// Parents by stochastic universal selection with expectations of 1/√rank, best first.
    fn parents(&mut self, order: &[usize], count: usize) -> Vec<[f64; N]> {
        let weight = |rank: usize| ((rank + 1) as f64).sqrt().recip();
        let total: f64 = (0..order.len()).map(weight).sum();
        let stride = total / count as f64;
        let mut pointer = self.uniform() * stride;
        let (mut rank, mut sum) = (0, weight(0));
        let mut parents = Vec::with_capacity(count);
        for _ in 0..count {
            while sum < pointer && rank + 1 < order.len() {
                rank += 1;
                sum += weight(rank);
            }
            parents.push(self.population[order[rank]]);
            pointer += stride;
        }
        // The order in which parents meet is random.
        for k in (1..parents.len()).rev() {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below k + 1")]
            let other = (self.uniform() * (k + 1) as f64) as usize;
            parents.swap(k, other.min(k));
        }
        parents
    }

    /// The next generation.
    fn breed(&mut self) {
        let mut order: Vec<usize> = (0..self.costs.len()).collect();
        order.sort_by(|&a, &b| self.costs[a].total_cmp(&self.costs[b]));
        let best = self.population[order[0]];
        self.record.pass(&best, self.costs[order[0]]);
        self.generation += 1;
        let elite = self.settings.elite;
        let others = self.settings.population - elite;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most the population")]
        let crossed = (self.settings.crossover * others as f64).round() as usize;
        let parents = self.parents(&order, 2 * crossed + (others - crossed));
        let mut next: Vec<[f64; N]> = order[..elite].iter().map(|&index| self.population[index]).collect();
        for pair in parents[..2 * crossed].chunks(2) {
            next.push(std::array::from_fn(|i| pair[0][i] + self.uniform() * (pair[1][i] - pair[0][i])));
        }
        let age = self.generation as f64 / self.settings.generations as f64;
        let spread = SPREAD * (1.0 - COOLING * age);
        for parent in &parents[2 * crossed..] {
            next.push(std::array::from_fn(|i| (parent[i] + spread * self.normal()).clamp(0.0, 1.0)));
        }
        self.population = next;
        self.costs.clear();
    }
}

impl<const N: usize> Search<N> for Genetic<N> {
    fn ask(&mut self) -> Option<[f64; N]> {
        let shares = self.population.get(self.costs.len())?;
        (self.generation < self.settings.generations).then(|| self.record.point(shares))
    }

    fn tell(&mut self, cost: f64) {
        if self.generation >= self.settings.generations {
            return;
        }
        let shares = self.population[self.costs.len()];
        let cost = self.record.note(&shares, cost);
        self.costs.push(cost);
        if self.costs.len() == self.population.len() {
            self.breed();
        }
    }

    fn best(&self) -> Option<Evaluated<N>> {
        self.record.best
    }

    fn path(&self) -> &[Evaluated<N>] {
        &self.record.path
    }
}
