import { chromium } from '@playwright/test';
import { serve } from '/work/main/tests/e2e/server.mjs';
const s=await serve();
const b=await chromium.launch({executablePath:'/usr/bin/chromium',args:['--no-sandbox','--disable-gpu']});
for (const [w,h,dark,lang] of [[1440,900,false,'en'],[390,844,true,'pt-BR'],[1024,768,false,'es']]) {
 const c=await b.newContext({viewport:{width:w,height:h},colorScheme:dark?'dark':'light'}); const p=await c.newPage();
 p.on('console',m=>console.log('CONSOLE',m.text())); p.on('pageerror',e=>console.log('ERR',e.message));
 const id=(t)=>p.getByTestId(t);
 await p.goto(s.origin+`/?lang=${lang}&view=full&preset=johansson-2000-minimum-phase`); await p.waitForSelector('#bench:not(.outline)'); await p.waitForTimeout(1500);
 await id('load-kind').selectOption('outlet3'); await p.waitForTimeout(300);
 await id('load-size-number').fill('-100'); await p.keyboard.press('Enter'); await p.waitForTimeout(500);
 await id('experiment-more').locator('summary').first().click();
 await id('flow-noise-number').fill('0.2'); await p.keyboard.press('Enter'); await p.waitForTimeout(800);
 await id('load-kind').scrollIntoViewIfNeeded();
 await p.screenshot({path:`/tmp/l1-${w}.png`,fullPage:true});
 await id('operating-point-fold').locator('summary').first().click();
 await id('rig-numbers').locator('summary').click(); await p.waitForTimeout(400);
 await id('rig-most1').fill('20'); await p.keyboard.press('Enter');
 await id('rig-start1').fill('2'); await p.keyboard.press('Enter'); await p.waitForTimeout(800);
 await id('rig-start1').scrollIntoViewIfNeeded();
 await p.screenshot({path:`/tmp/l2-${w}.png`});
 console.log(w, await p.evaluate(()=>document.documentElement.scrollWidth), await id('rig-most1').inputValue(), await id('rig-most2').inputValue());
 await c.close();
}
await b.close(); process.exit(0);
